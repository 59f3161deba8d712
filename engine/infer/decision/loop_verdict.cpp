#include "engine/infer/decision/loop_verdict.hpp"

#include <algorithm>

#include "engine/effects/carry_over.hpp"

namespace torquescope {

bool StandingNames::any() const {
  return has_delay || !added.empty() || std::find(effects.begin(), effects.end(), true) != effects.end();
}

StandingNames standing_names(DecisionFacts const& scan, LoopFacts const& loop) {
  StandingNames names;
  names.by_loop = loop.decides();
  names.effects.assign(scan.accepted.size(), true);
  names.has_delay = scan.delay.is_named;
  if (!names.by_loop) return names;
  bool const has_command = std::any_of(loop.kept.begin(), loop.kept.end(),
                                       [](KeptMove const& move) { return move.subject.is_of_command(); });
  for (std::size_t i = 0; i < scan.accepted.size(); ++i) {
    Effect const* const effect = scan.accepted[i].effect;
    // other recordings say nothing of a clock: only another explanation speaks against it
    names.effects[i] = loop.is_kept({effect}) || (is_clock_bound(*effect) && !has_command && !loop.is_chance({effect}));
  }
  LoopSubject const delay{nullptr, LoopKey::command_delay_s};
  bool const asks_command = loop.form != LoopForm::identified;
  // one that is a rival of another name stands in its class
  if (asks_command)
    names.has_delay =
        std::any_of(loop.kept.begin(), loop.kept.end(), [&](KeptMove const& move) { return move.subject == delay; });
  for (auto const& move : loop.kept) {
    if (move.subject == delay) {
      names.command_delay = move.numbers.front();
      continue;
    }
    auto const is_told = [&](EffectFacts const& facts) {
      LoopSubject const subject{facts.effect};
      return move.subject == subject || std::find(move.rivals.begin(), move.rivals.end(), subject) != move.rivals.end();
    };
    if (std::none_of(scan.accepted.begin(), scan.accepted.end(), is_told)) names.added.push_back(move);
  }
  return names;
}

DecisionFacts judged_in_loop(DecisionFacts scan, LoopFacts const& loop) {
  if (!loop.decides()) return scan;
  for (auto& step : scan.steps)
    for (auto& effect : step.effects)
      if (loop.is_chance({effect.effect})) effect.refusal = Refusal::chance;
  return scan;
}

}  // namespace torquescope
