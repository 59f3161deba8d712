#include <utility>

#include "engine/base/contract.hpp"
#include "engine/data/filter_checks.hpp"
#include "engine/data/motion.hpp"
#include "engine/data/zero_phase.hpp"

namespace torquescope {
namespace {

// central differences inside, one-sided at both ends
Eigen::VectorXd derivative(Eigen::VectorXd const& signal, double rate_hz) {
  Eigen::Index const n = signal.size();
  Eigen::VectorXd result(n);
  result[0] = (signal[1] - signal[0]) * rate_hz;
  result[n - 1] = (signal[n - 1] - signal[n - 2]) * rate_hz;
  result.segment(1, n - 2) = (signal.tail(n - 2) - signal.head(n - 2)) * (rate_hz / 2);
  return result;
}

}  // namespace

Motion differentiate(Recording&& recording, FilterOptions const& options, Section const& section) {
  TORQUESCOPE_EXPECT(recording.position.size() == recording.torque.size());
  check_cutoff("cutoff_hz", options.cutoff_hz, recording.rate_hz, section);
  check_length(options, recording.position.size(), recording.rate_hz);

  auto const smooth = [&](Eigen::VectorXd&& signal) -> Eigen::VectorXd {
    if (options.cutoff_hz == 0) return std::move(signal);
    return zero_phase(butterworth_lowpass(static_cast<int>(options.order), options.cutoff_hz, recording.rate_hz),
                      signal);
  };
  Motion motion;
  motion.rate_hz = recording.rate_hz;
  motion.time_s = std::move(recording.time_s);
  motion.q = smooth(std::move(recording.position));
  motion.dq =
      recording.velocity.size() > 0 ? smooth(std::move(recording.velocity)) : derivative(motion.q, motion.rate_hz);
  motion.ddq = recording.acceleration.size() > 0 ? smooth(std::move(recording.acceleration))
                                                 : derivative(motion.dq, motion.rate_hz);
  motion.torque = std::move(recording.torque);
  return motion;
}

Motion differentiate(Recording const& recording, FilterOptions const& options, Section const& section) {
  Recording channels;
  channels.rate_hz = recording.rate_hz;
  channels.time_s = recording.time_s;
  channels.position = recording.position;
  channels.torque = recording.torque;
  channels.velocity = recording.velocity;
  channels.acceleration = recording.acceleration;
  return differentiate(std::move(channels), options, section);
}

}  // namespace torquescope
