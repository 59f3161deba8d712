#include "engine/infer/decision/names_on_rows.hpp"

#include <utility>
#include <vector>

#include "engine/infer/decision/accepted_model.hpp"

namespace torquescope {

std::optional<ModelErrors> errors_of_names(DecisionQuestion const& question, JointDecision const& scan,
                                           LoopFacts const& loop, StandingNames const& names) {
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
  for (std::size_t i = 0; i < names.effects.size(); ++i)
    if (EffectFacts const& own = scan.facts.accepted[i]; names.effects[i] && !loop.may_be_kept({own.effect}))
      effects.push_back({own.effect, own.shape});
  return errors_of(scan.rows, fitted_model(scan.rows, question.regressor, std::move(effects), scan.final.fitted.get(),
                                           free_delay(question.numbers)));
}

bool leave_more(ModelErrors const& names, ModelErrors const& scan, double least_fall) {
  return scan.judged() < (1.0 - least_fall) * names.judged();
}

}  // namespace torquescope
