#include "engine/infer/decision/loop_verdict.hpp"

#include <algorithm>

#include "engine/effects/carry_over.hpp"

namespace torquescope {

bool StandingNames::any() const {
  return has_delay || !added.empty() || std::find(effects.begin(), effects.end(), true) != effects.end();
}

namespace {

LoopSubject const command_delay{nullptr, LoopKey::command_delay_s};

// of a kept move: whether it tells an effect
using Tells = bool (KeptMove::*)(LoopSubject const&) const;

// which effects of the scan a kept move tells
std::vector<bool> told_effects(DecisionFacts const& scan, LoopFacts const& loop, Tells tells) {
  bool const has_command =
      std::any_of(loop.kept.begin(), loop.kept.end(), [](auto const& move) { return move.subject.is_of_command(); });
  std::vector<bool> told;
  for (auto const& facts : scan.accepted) {
    LoopSubject const subject{facts.effect};
    bool const is_told =
        std::any_of(loop.kept.begin(), loop.kept.end(), [&](auto const& move) { return (move.*tells)(subject); });
    // other recordings say nothing of a clock: only another explanation speaks against it
    bool const runs_by_itself = is_clock_bound(*facts.effect) && !has_command && !loop.is_chance(subject);
    told.push_back(is_told || (runs_by_itself && !loop.may_be_kept(subject)));
  }
  return told;
}

// kept moves that tell no effect of the scan
std::vector<KeptMove> further_moves(DecisionFacts const& scan, LoopFacts const& loop, Tells tells) {
  std::vector<KeptMove> further;
  for (auto const& move : loop.kept) {
    bool const is_told = std::any_of(scan.accepted.begin(), scan.accepted.end(),
                                     [&](EffectFacts const& facts) { return (move.*tells)({facts.effect}); });
    if (!is_told && !(move.subject == command_delay)) further.push_back(move);
  }
  return further;
}

}  // namespace

StandingNames standing_names(DecisionFacts const& scan, LoopFacts const& loop) {
  StandingNames names;
  names.by_loop = loop.decides();
  names.effects.assign(scan.accepted.size(), true);
  names.has_delay = scan.delay.is_named;
  if (!names.by_loop) return names;
  names.effects = told_effects(scan, loop, &KeptMove::may_be);
  names.added = further_moves(scan, loop, &KeptMove::may_be);
  names.drops_effects = std::find(names.effects.begin(), names.effects.end(), false) != names.effects.end();
  names.of_other_model = names.drops_effects || !names.added.empty();
  if (names.of_other_model) {
    names.effects = told_effects(scan, loop, &KeptMove::is);
    names.added = further_moves(scan, loop, &KeptMove::is);
  }
  auto const delay = std::find_if(loop.kept.begin(), loop.kept.end(),
                                  [](KeptMove const& move) { return move.subject == command_delay; });
  if (delay != loop.kept.end()) names.command_delay = delay->numbers.front();
  // one that is a rival of another name stands in its class
  bool const asks_command = loop.form != LoopForm::identified;
  if (asks_command) names.has_delay = names.command_delay.has_value();
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
