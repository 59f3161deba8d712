#include "engine/fit/problem/loss.hpp"

namespace torquescope {

std::vector<LossChoice> const& loss_choices() {
  static std::vector<LossChoice> const choices{
      {LossKind::squares, "squares", "squared residuals", "e^2", "seed eq. 10"},
      {LossKind::huber, "huber", "squares for small residuals, a constant pull for large ones",
       "e^2 if |e| <= delta, else delta (2 |e| - delta)", "Huber 1964, Robust estimation of a location parameter"}};
  return choices;
}

LossChoice const* find_loss(std::string const& name) {
  for (auto const& choice : loss_choices())
    if (choice.name == name) return &choice;
  return nullptr;
}

}  // namespace torquescope
