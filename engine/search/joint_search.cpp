#include "engine/search/joint_search.hpp"

#include <memory>
#include <utility>

#include "engine/base/error.hpp"
#include "engine/search/channel_timing.hpp"
#include "engine/search/friction_buildup.hpp"
#include "engine/search/motion_echo.hpp"

namespace torquescope {
namespace {

constexpr double follows_p = 0.005;  // as a candidate that is certain

// A controller's law is one of the torque as its rows say it: put back in time, the torque of a stiff one is no longer
// what it answers. The loop that was found before stays, if twins follow in it
Selection select_in_loop(StageSetting& setting, std::shared_ptr<RecordedLoop const> const& as_read,
                         SelectionOptions const& options, StageSink const& progress) {
  if (!setting.loop && loses_the_law(*as_read, setting.recording)) {
    setting.loop = as_read;
    try {
      return select_effects(setting, options, progress);
    } catch (Error const&) {
      setting.loop = nullptr;
    }
  }
  return select_effects(setting, options, progress);
}

}  // namespace

Selection search_in_time(StageSetting& setting, Recording& recording, SelectionOptions const& options,
                         StageSink const& progress, double& late_s) {
  constexpr int most_times = 2;  // the second for what other effects hid of it
  Selection selection = select_effects(setting, options, progress);
  auto const as_read = std::make_shared<RecordedLoop const>(selection.baseline->twin->loop);
  for (int i = 0; i < most_times; ++i) {
    bool const is_unexplained = judge_remainder(selection, *selection.final).is_unexplained;
    auto more_s = delay_within_a_sample(selection, is_unexplained, late_s, recording.rate_hz);
    // where the law says that the rows are in time, that something is unexplained is no reason to move them
    if (more_s && is_unexplained && loses_the_law(*as_read, with_torque_earlier(recording, *more_s)))
      more_s = delay_within_a_sample(selection, false, late_s, recording.rate_hz);
    if (!more_s) break;
    late_s += *more_s;
    recording = with_torque_earlier(std::move(recording), *more_s);
    selection = select_in_loop(setting, as_read, options, progress);
  }
  if (selection.baseline->twin->colour) setting.reads_colour = true;
  return selection;
}

Selection doubt_noise(StageSetting& setting, SelectionOptions const& options, Selection selection,
                      StageSink const& progress) {
  bool const has_colour = selection.baseline->twin->colour.has_value();
  if (has_colour || !judge_remainder(selection, *selection.final).is_unexplained) return selection;
  StageSetting coloured = setting;
  coloured.reads_colour = true;
  SelectionOptions gate = options;
  gate.only_gate = true;
  try {
    Selection among_coloured = select_effects(coloured, gate, progress);
    ModelStage const& coloured_baseline = *among_coloured.baseline;
    bool const is_no_noise = coloured_baseline.twin->colour && coloured_baseline.twin->colour->misfit_p < follows_p;
    if (among_coloured.is_gate_open || is_no_noise || motion_echo_p(coloured_baseline) < follows_p) return selection;
    setting.reads_colour = true;
    return among_coloured;
  } catch (Error const&) {
    return selection;  // the recording itself was good enough for twins without
  }
}

Remainder judge_with_reversals(StageSetting& setting, SelectionOptions const& options, Selection& selection,
                               StageSink const& progress) {
  Remainder remainder = judge_remainder(selection, *selection.final);
  bool const has_structure = remainder.is_unexplained && !remainder.is_most_left;
  if (has_structure && !selection.accepted.empty()) return remainder;
  if (setting.reversals == ReversalRows::weigh) return remainder;  // they were never left out
  // how a joint is driven through a reversal nobody knows who does not know its controller
  if (selection.baseline->twin->colour) return remainder;
  // what a late channel's law leaves of a reversal, which is over in a few rows, looks like friction that builds up
  static Effect const* const delay = find_effect("delay");
  if (selection.has_accepted(delay)) return remainder;
  Selection const before = selection;
  look_at_reversals(setting, options, selection, progress);
  if (!selection.keeps_reversals) return remainder;
  Remainder with_reversals = judge_remainder(selection, *selection.final);
  if (with_reversals.is_unexplained && !remainder.is_unexplained) {
    selection = before;
    selection.differs_at_reversals = true;
    return remainder;
  }
  setting.keeps_reversals = true;
  return with_reversals;
}

}  // namespace torquescope
