#include "engine/infer/decision/loop_tracks.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "engine/base/error.hpp"
#include "engine/simulate/controller_fit.hpp"
#include "engine/simulate/rollout/loop_gains.hpp"

namespace torquescope {
namespace {

std::vector<RolloutTrack> led_tracks(std::span<Recording const> recordings, LoopOptions const& loop) {
  std::vector<RolloutTrack> tracks;
  for (auto const& recording : recordings) {
    if (recording.reference.size() != recording.position.size()) continue;
    RolloutTrack track = track_of(recording, track_options(loop));
    if (track.drive == TrackDrive::reference) tracks.push_back(std::move(track));
  }
  return tracks;
}

// found in the track itself; none where its signals do not bear one
std::optional<LoopController> controller_in(RolloutTrack const& track, double added_gain) {
  try {
    Eigen::VectorXd torque = track.torque;
    if (track.added.size() > 0) torque -= added_gain * track.added;
    return fit_controller({track.time_s, track.reference, track.position, torque, nullptr}).controller;
  } catch (Error const&) {
    return std::nullopt;
  }
}

// gains that a form begins with, and over how many samples it sees the speed
LoopSetting with_gains(LoopSetting setting, std::vector<LoopKey> const& missing, bool finds_span,
                       std::vector<RolloutTrack> const& tracks) {
  if (gains_of(setting.form).empty()) return setting;
  if (setting.speed_samples > 0 && finds_span)
    setting.speed_samples = speed_span(setting.form, setting.values, missing, tracks);
  setting.values = with_first_gains(setting.form, setting.values, missing, setting.speed_samples, tracks);
  return setting;
}

double error_of(LoopSetting const& setting, RolloutTrack const& track) {
  return loop_error(numbers_of(setting.form, setting.values), setting.speed_samples, track);
}

// the plainest controller that answers no worse than one of many numbers
std::optional<LoopSetting> plain_form(LoopOptions loop, LoopController const& controller, double controller_error,
                                      double computed, std::vector<RolloutTrack> const& tracks) {
  constexpr double about_as_well = 1.1;
  double const most_error = std::max(computed, about_as_well * controller_error);
  if (std::isnan(loop.torque_limit) && std::isfinite(controller.most)) loop.torque_limit = controller.most;
  for (char const* form : {"p", "pd"}) {
    loop.controller = form;
    LoopSetting setting = loop_setting(loop, tracks.front().rate_hz);
    setting = with_gains(std::move(setting), missing_gains(loop), loop.speed_samples == 0, tracks);
    double worst = 0.0;
    for (auto const& track : tracks) worst = std::max(worst, error_of(setting, track));
    if (worst > most_error) continue;
    // gains that the torque was computed with are known
    if (worst <= computed) setting.free.clear();
    return setting;
  }
  return std::nullopt;
}

// one controller led all recordings of a rig: that of the first where it answers another more closely than the other's
// own
void share_first(std::vector<RolloutTrack>& tracks, LoopController const& first) {
  for (auto& track : tracks)
    if (!track.controller || loop_error(first, track) < loop_error(*track.controller, track)) track.controller = first;
}

void find_controller(LoopTracks& made, LoopOptions const& loop, DecisionNumbers const& numbers) {
  constexpr double nothing = 1.0;
  double const added_gain = made.setting.values[LoopKey::added_command_gain];
  auto const first = controller_in(made.training.front(), added_gain);
  double const of_controller = first ? loop_error(*first, made.training.front()) : nothing;
  if (auto const plain =
          plain_form(loop, first.value_or(LoopController{}), of_controller, numbers.computed_torque, made.training)) {
    made.setting = *plain;
    made.loop_error = error_of(*plain, made.training.front());
    return;
  }
  made.loop_error = of_controller;
  if (!first) return;
  for (auto* tracks : {&made.training, &made.validation}) {
    for (auto& track : *tracks) track.controller = controller_in(track, added_gain);
    share_first(*tracks, *first);
  }
}

}  // namespace

LoopTracks loop_tracks(std::span<Recording const> training, std::span<Recording const> validation,
                       LoopOptions const& loop, DecisionNumbers const& numbers) {
  LoopTracks made;
  made.training = led_tracks(training, loop);
  made.validation = led_tracks(validation, loop);
  made.counts = channels_of(loop);
  if (made.training.empty()) return made;
  made.setting = loop_setting(loop, made.training.front().rate_hz);
  if (made.setting.form == LoopForm::identified) {
    find_controller(made, loop, numbers);
  } else {
    made.setting = with_gains(made.setting, missing_gains(loop), loop.speed_samples == 0, made.training);
    made.loop_error = error_of(made.setting, made.training.front());
  }
  if (made.setting.form == LoopForm::p && made.loop_error <= numbers.computed_torque && made.counts[0])
    made.counts[1] = false;
  return made;
}

}  // namespace torquescope
