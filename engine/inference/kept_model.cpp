#include "engine/inference/kept_model.hpp"

#include <cmath>
#include <optional>
#include <utility>

namespace torquescope {
namespace {

// replicates in the recording's own loop, and a model that they bear out: however small, what is clear is there
bool is_borne_out(SearchState const& state) {
  return state.adequacy.holds() && state.selection.baseline->twin->loop.source == LoopSource::identified;
}

bool falls_enough(HeldOutGain const& gain, SearchState const& state, DecisionLevels const& levels) {
  if (gain.change != HeldOutChange::lower) return false;
  return is_borne_out(state) || std::sqrt(gain.after / gain.before) < 1.0 - levels.least_fall;
}

KeptModel judged(StepwiseSearch const& search, SearchState const& state, std::span<Recording const> unseen,
                 DecisionLevels const& levels) {
  KeptModel kept{state, held_out_errors(search.setting, unseen, state.selection)};
  HeldOut const& held_out = kept.held_out;
  if (held_out.acting.blocks > 0) {
    kept.is_held_out_lower =
        falls_enough(held_out.acting, state, levels) && held_out.gain.is_not_worse() && state.adequacy.holds();
    return kept;
  }
  kept.is_held_out_lower = falls_enough(held_out.gain, state, levels);
  kept.explains_most = held_out.gain.after < most_of_it * held_out.gain.before;
  return kept;
}

}  // namespace

KeptModel keep_what_predicts(StepwiseSearch const& search, std::span<Recording const> unseen,
                             DecisionLevels const& levels) {
  std::optional<KeptModel> whole;
  for (auto state = search.states.rbegin(); state != search.states.rend(); ++state) {
    if (state->selection.accepted.empty() && whole) break;
    KeptModel kept = judged(search, *state, unseen, levels);
    bool const is_right_to_stop = state->selection.accepted.empty() ||
                                  (kept.is_held_out_lower && (state->adequacy.holds() || kept.explains_most));
    if (is_right_to_stop) return kept;
    if (!whole) whole = std::move(kept);
  }
  return std::move(*whole);
}

}  // namespace torquescope
