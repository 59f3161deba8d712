#include "engine/infer/moving_rows/kept_model.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "engine/effects/carry_over.hpp"

namespace torquescope {
namespace {

KeptModel judged(StepwiseSearch const& search, SearchState const& state, OtherRecordings const& others) {
  KeptModel kept{state, held_out_errors(search.setting, others, state.selection, state.evidence->weights_unseen(),
                                        state.adequacy.holds() ? Blocks::where_it_acts : Blocks::alike)};
  HeldOut const& held_out = kept.held_out;
  auto const& deciding = held_out.acting.blocks > 0 ? held_out.acting : held_out.gain;
  if (deciding.before > 0.0) kept.fall = 1.0 - std::sqrt(deciding.after / deciding.before);
  if (held_out.acting.blocks > 0) {
    kept.is_held_out_lower = held_out.acting.change == HeldOutChange::lower && held_out.gain.is_not_worse() &&
                             state.adequacy.holds() && !held_out.left_out.is_raised();
    return kept;
  }
  kept.is_held_out_lower = held_out.gain.change == HeldOutChange::lower && !held_out.left_out.is_raised();
  kept.explains_most = held_out.gain.after < most_of_it * held_out.gain.before;
  return kept;
}

bool stands(KeptModel const& kept) {
  if (kept.state.selection.accepted.empty()) return true;
  return kept.is_held_out_lower && (kept.state.adequacy.holds() || kept.explains_most);
}

// whether the last law is of use: the longer part leaves clearly less of held-out rows. One of a clock says nothing of
// them, and is there because the model is adequate with it
bool predicts_less(KeptModel const& shorter, KeptModel const& longer) {
  if (is_clock_bound(*longer.state.selection.accepted.back().effect)) return true;
  auto const& before = shorter.held_out.left;
  auto const& after = longer.held_out.left;
  std::vector<HeldOutBlock> blocks;
  for (std::size_t i = 0; i < std::min(before.size(), after.size()); ++i) {
    // another mask: rows cannot be paired
    if (before[i].left.size() != after[i].left.size()) return longer.held_out.gain.after < shorter.held_out.gain.after;
    auto const own = held_out_blocks(before[i].left, after[i].left, after[i].memory_rows);
    blocks.insert(blocks.end(), own.begin(), own.end());
  }
  Blocks const which = longer.state.adequacy.holds() ? Blocks::where_it_acts : Blocks::alike;
  return held_out_gain(blocks, which).change == HeldOutChange::lower;
}

}  // namespace

KeptModel keep_what_predicts(StepwiseSearch const& search, OtherRecordings const& others) {
  KeptModel whole = judged(search, search.end(), others);
  KeptModel longer = whole;
  for (std::size_t i = search.states.size() - 1; i > 0; --i) {
    if (search.states[i - 1].selection.accepted.empty()) return stands(longer) ? longer : whole;
    KeptModel shorter = judged(search, search.states[i - 1], others);
    if (stands(longer) && (!stands(shorter) || predicts_less(shorter, longer))) return longer;
    longer = std::move(shorter);
  }
  return whole;
}

}  // namespace torquescope
