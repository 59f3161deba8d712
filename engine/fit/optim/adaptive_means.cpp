#include "engine/fit/optim/adaptive_means.hpp"

namespace torquescope {

void AdaptiveMeans::learn(std::span<TrialControls const> successes) {
  if (successes.empty()) return;
  double squares = 0.0, sum = 0.0, rates = 0.0;
  for (auto const& [F, CR] : successes) {
    squares += F * F;
    sum += F;
    rates += CR;
  }
  double const kept = 1.0 - learning_rate_;
  means_.F = kept * means_.F + learning_rate_ * (squares / sum);
  means_.CR = kept * means_.CR + learning_rate_ * (rates / static_cast<double>(successes.size()));
}

}  // namespace torquescope
