#include "engine/diagnose/joint_search.hpp"

#include <cmath>
#include <utility>

#include "engine/diagnose/channel_timing.hpp"
#include "engine/diagnose/friction_buildup.hpp"

namespace torquescope {

Selection search_in_time(StageSetting const& setting, Recording& recording, SelectionOptions const& options,
                         StageSink const& progress, double& late_s) {
  constexpr int most_times = 2;  // the second for what other effects hid of it
  Selection selection = select_effects(setting, options, progress);
  for (int i = 0; i < most_times; ++i) {
    auto const more_s = delay_within_a_sample(selection, recording.rate_hz);
    if (!more_s || std::abs(late_s + *more_s) * recording.rate_hz >= 1.0) break;
    late_s += *more_s;
    recording = with_torque_earlier(std::move(recording), *more_s);
    selection = select_effects(setting, options, progress);
  }
  return selection;
}

Remainder judge_with_reversals(StageSetting& setting, SelectionOptions const& options, Selection& selection,
                               StageSink const& progress) {
  Remainder remainder = judge_remainder(selection, *selection.final);
  bool const has_structure = remainder.is_unexplained && !remainder.is_most_left;
  if (has_structure && !selection.accepted.empty()) return remainder;
  // how a joint is driven through a reversal nobody knows who does not know its controller
  if (selection.baseline->twin->colour) return remainder;
  Selection const before = selection;
  look_at_reversals(setting, options, selection, progress);
  if (!selection.keeps_reversals) return remainder;
  Remainder with_reversals = judge_remainder(selection, *selection.final);
  if (with_reversals.is_unexplained && !remainder.is_unexplained) {
    selection = before;
    return remainder;
  }
  setting.keeps_reversals = true;
  return with_reversals;
}

}  // namespace torquescope
