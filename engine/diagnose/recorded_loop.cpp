#include "engine/diagnose/recorded_loop.hpp"

#include <algorithm>
#include <cmath>

#include "engine/data/signal_facts.hpp"

namespace torquescope {
namespace {

// a line through the first samples: the joint may have been moving when the recording began
double first_velocity(Recording const& recording) {
  constexpr double seconds = 0.02;
  Eigen::Index const n =
      std::clamp<Eigen::Index>(std::llround(seconds * recording.rate_hz), 3, recording.position.size());
  double numerator = 0.0, denominator = 0.0;
  double const middle = 0.5 * static_cast<double>(n - 1);
  for (Eigen::Index k = 0; k < n; ++k) {
    double const x = static_cast<double>(k) - middle;
    numerator += x * (recording.position[k] - recording.position[0]);
    denominator += x * x;
  }
  double const slope = numerator / denominator;
  // less than one encoder step in all that time is rest
  return std::abs(slope) * static_cast<double>(n - 1) <= recording.rows.encoder_step ? 0.0 : slope * recording.rate_hz;
}

RecordedLoop common_parts(Recording const& recording) {
  RecordedLoop result;
  result.loop.encoder_step =
      recording.rows.encoder_step > 0.0
          ? recording.rows.encoder_step
          : quantisation_step({recording.position.data(), static_cast<std::size_t>(recording.position.size())});
  result.track.rate_hz = recording.rate_hz;
  result.track.start_position = recording.position[0];
  result.track.start_velocity = first_velocity(recording);
  constexpr double runaway = 3.0;  // times the recording's largest torque
  result.track.largest_torque = runaway * recording.torque.cwiseAbs().maxCoeff();
  return result;
}

}  // namespace

RecordedLoop recorded_loop(Recording const& recording, double inertia, FilterOptions const& filter) {
  if (recording.reference.size() != recording.position.size()) {
    RecordedLoop own = tracking_loop(recording, inertia, filter);
    own.remark = "there is no reference: " + own.remark;
    return own;
  }
  RecordedLoop result = common_parts(recording);
  result.track.reference = recording.reference;
  result.controller = fit_controller({recording.time_s, recording.reference, recording.position, recording.torque});
  result.source = result.controller->is_white ? LoopSource::identified : LoopSource::approximated;
  result.loop.law = result.controller->law;
  result.loop.torque_noise = result.controller->noise;
  result.remark = result.controller->remark;
  return result;
}

RecordedLoop tracking_loop(Recording const& recording, double inertia, FilterOptions const& filter) {
  constexpr double bandwidth_share = 0.03;  // of the rate
  RecordedLoop result = common_parts(recording);
  result.source = LoopSource::tracking;
  result.track.reference = differentiate(recording, filter, {}).q;
  result.loop.law = tracking_law(inertia, bandwidth_share * recording.rate_hz, recording.rate_hz);
  result.loop.torque_noise = white(white_noise(recording.torque));
  result.remark = "twins follow the measured motion in a stiff loop of our own";
  return result;
}

}  // namespace torquescope
