#include "engine/infer/pipeline/recorded_loop.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "engine/data/encoder_step.hpp"
#include "engine/data/filter_checks.hpp"
#include "engine/data/signal_facts.hpp"
#include "engine/infer/pipeline/drive_torque.hpp"

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

// Whether a loop of our own is the last resort: the controller is that of a reference, and a joint that runs away even
// so is what the torque cannot be right for. Of an arm's joint the controller is known less well: what the others need
// is fitted
bool is_last_resort(Recording const& recording) {
  bool const is_of_arm = recording.given != nullptr;
  return recording.reference.size() == recording.position.size() && !is_of_arm;
}

constexpr double bandwidth_share = 0.03;  // of the rate
constexpr double runaway = 3.0;           // times the largest torque of the recording, or of the model along its motion

RecordedLoop common_parts(Recording const& recording) {
  RecordedLoop result;
  result.loop.encoder_step = encoder_step(recording);
  result.track.rate_hz = recording.rate_hz;
  result.track.start_position = recording.position[0];
  result.track.start_velocity = first_velocity(recording);
  result.track.largest_torque = runaway * drive_torque(recording).cwiseAbs().maxCoeff();
  return result;
}

// A step of the encoder must not ask for more torque than the recording has: at a high rate a stiff loop would shake
// the joint by rounding alone. Its answer is 2 inertia omega per difference of one sample
double widest_of_encoder(Recording const& recording, double inertia) {
  double const step = recording.rows.encoder_step;
  if (step <= 0.0 || is_last_resort(recording)) return std::numeric_limits<double>::infinity();
  double const torque_rms = std::sqrt(recording.torque.squaredNorm() / static_cast<double>(recording.torque.size()));
  return torque_rms / (4.0 * std::numbers::pi * inertia * recording.rate_hz * step);
}

// A low-passed signal. Beyond its ends it goes on as its odd reflection, for as long as the filter remembers: what a
// filter makes of the end of a motion is an acceleration that no joint had, and replicates that follow it run away
Eigen::VectorXd smoothed(Eigen::VectorXd const& q, double rate_hz, FilterOptions const& filter) {
  if (filter.cutoff_hz == 0.0) return q;
  constexpr double periods = 3.0;
  Eigen::Index const n = q.size();
  Eigen::Index const pad = std::min(n - 1, static_cast<Eigen::Index>(std::ceil(periods * rate_hz / filter.cutoff_hz)));
  Recording longer;
  longer.rate_hz = rate_hz;
  longer.position.resize(n + 2 * pad);
  longer.position.segment(pad, n) = q;
  longer.position.head(pad) = 2.0 * q[0] - q.segment(1, pad).reverse().array();
  longer.position.tail(pad) = 2.0 * q[n - 1] - q.segment(n - 1 - pad, pad).reverse().array();
  longer.torque = Eigen::VectorXd::Zero(longer.position.size());
  return differentiate(std::move(longer), filter, {}).q.segment(pad, n);
}

// the measured motion without what its encoder adds
Eigen::VectorXd smoothed_motion(Recording const& recording, FilterOptions const& filter) {
  if (is_last_resort(recording)) return differentiate(recording, filter, {}).q;
  return smoothed(recording.position, recording.rate_hz, filter);
}

// The largest torque that the joint needs along a motion. A model that explains little of a recording may need more
// than was recorded, on rows that nothing is fitted to: a joint that is led along has not run away for that. The ends
// do not count, where a filter makes accelerations of the encoder's noise
double most_needed(TrackedJoint const& joint, Eigen::VectorXd const& q, double rate_hz, Eigen::Index edge) {
  double most = 0.0;
  edge = std::max<Eigen::Index>(edge, 1);
  for (Eigen::Index k = edge; k + edge < q.size(); ++k) {
    double const velocity = 0.5 * rate_hz * (q[k + 1] - q[k - 1]);
    double const acceleration = rate_hz * rate_hz * (q[k + 1] - 2.0 * q[k] + q[k - 1]);
    double const dry = velocity > 0.0 ? joint.forward : joint.backward;
    double const gravity = joint.gravity_sin * std::sin(q[k]) + joint.gravity_cos * std::cos(q[k]);
    most = std::max(most, std::abs(joint.inertia * acceleration + joint.viscous * velocity + dry + gravity));
  }
  return most;
}

// Below it the velocity of the smoothed motion may be noise alone. What smoothing takes away is noise, and as much of
// it per hertz is left below the cut-off
double slowest_velocity(Recording const& recording, Eigen::VectorXd const& smooth, double encoder_step,
                        FilterOptions const& filter) {
  constexpr double standard_deviations = 5.0;
  double const taken_away = std::sqrt((recording.position - smooth).squaredNorm() / static_cast<double>(smooth.size()));
  double const noise = std::max({taken_away, encoder_step / std::sqrt(12.0), std::numeric_limits<double>::min()});
  double const half_rate = 0.5 * recording.rate_hz;
  double const band_hz = filter.cutoff_hz > 0.0 ? std::min(filter.cutoff_hz, half_rate) : half_rate;
  double const share = band_hz / half_rate;
  return standard_deviations * 2.0 * std::numbers::pi * band_hz * noise * std::sqrt(share / 3.0);
}

}  // namespace

RecordedLoop tracking_loop(Recording const& recording, TrackedJoint const& joint, FilterOptions const& filter) {
  RecordedLoop result = common_parts(recording);
  result.track.reference = smoothed_motion(recording, filter);
  if (!is_last_resort(recording))
    result.track.largest_torque =
        std::max(result.track.largest_torque, runaway * most_needed(joint, result.track.reference, recording.rate_hz,
                                                                    edge_samples(filter, recording.rate_hz)));
  double const bandwidth_hz =
      std::min(bandwidth_share * recording.rate_hz, widest_of_encoder(recording, joint.inertia));
  double const slow = slowest_velocity(recording, result.track.reference, result.loop.encoder_step, filter);
  result.loop.controller = tracking_controller(joint, bandwidth_hz, {recording.rate_hz, slow});
  result.loop.torque_noise = white(white_noise(recording.torque));
  return result;
}

RecordedLoop torque_fed_loop(Recording const& recording, double inertia, FilterOptions const& filter) {
  constexpr double tenth = 0.1;  // of the filter's cut-off: friction turns round within its period
  RecordedLoop result = common_parts(recording);
  result.track.reference = smoothed(recording.position, recording.rate_hz, filter);
  result.track.fed_forward = smoothed(recording.torque, recording.rate_hz, filter);
  double const widest = bandwidth_share * recording.rate_hz;
  double const bandwidth_hz = filter.cutoff_hz > 0.0 ? std::min(tenth * filter.cutoff_hz, widest) : widest;
  result.loop.controller = error_controller(inertia, bandwidth_hz, recording.rate_hz);
  result.loop.sees_motion = true;
  return result;
}

}  // namespace torquescope
