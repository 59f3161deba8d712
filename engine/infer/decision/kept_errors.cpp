#include "engine/infer/decision/kept_errors.hpp"

#include <utility>
#include <vector>

namespace torquescope {

std::optional<ModelErrors> kept_errors(DecisionQuestion const& question, JointDecision const& scan,
                                       LoopFacts const& loop) {
  LoopSubject const delay{nullptr, LoopKey::command_delay_s};
  std::vector<ShapedEffect> effects;
  for (auto const& move : loop.kept) {
    if (move.subject == delay) continue;  // the rows have a delay of their own
    if (move.subject.is_of_command()) return std::nullopt;
    ShapedEffect effect{move.subject.effect, {}};
    for (std::size_t k = effect.effect->n_linear(); k < move.numbers.size(); ++k)
      effect.shape.push_back(move.numbers[k].value);
    effects.push_back(std::move(effect));
  }
  return errors_of(scan.rows, fitted_model(scan.rows, question.regressor, std::move(effects), scan.final.fitted.get(),
                                           {DelaySearch::everywhere, question.numbers.longest_delay_s}));
}

}  // namespace torquescope
