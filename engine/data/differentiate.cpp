#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/base/contract.hpp"
#include "engine/data/filter_checks.hpp"
#include "engine/data/motion.hpp"
#include "engine/data/zero_phase.hpp"

namespace torquescope {
Eigen::VectorXd central_derivative(Eigen::Ref<Eigen::VectorXd const> const& signal, double rate_hz) {
  Eigen::Index const n = signal.size();
  Eigen::VectorXd result(n);
  result[0] = (signal[1] - signal[0]) * rate_hz;
  result[n - 1] = (signal[n - 1] - signal[n - 2]) * rate_hz;
  result.segment(1, n - 2) = (signal.tail(n - 2) - signal.head(n - 2)) * (rate_hz / 2);
  return result;
}

Eigen::MatrixXd smooth_positions(Eigen::Ref<Eigen::MatrixXd const> const& positions, FilterOptions const& options,
                                 double rate_hz) {
  if (options.cutoff_hz == 0) return positions;
  return zero_phase_columns(butterworth_lowpass(static_cast<int>(options.order), options.cutoff_hz, rate_hz),
                            positions);
}

Motion differentiate_smooth(Recording&& recording) {
  TORQUESCOPE_EXPECT(recording.position.size() == recording.torque.size());
  Motion motion;
  motion.rate_hz = recording.rate_hz;
  motion.time_s = std::move(recording.time_s);
  motion.q = std::move(recording.position);
  motion.dq =
      recording.velocity.size() > 0 ? std::move(recording.velocity) : central_derivative(motion.q, motion.rate_hz);
  motion.ddq = recording.acceleration.size() > 0 ? std::move(recording.acceleration)
                                                 : central_derivative(motion.dq, motion.rate_hz);
  motion.torque = std::move(recording.torque);
  motion.left_out = std::move(recording.left_out);
  motion.left_out_because = std::move(recording.left_out_because);
  return motion;
}

Motion thinned(Motion const& motion, Eigen::Index first, Eigen::Index step) {
  Eigen::Index const count = (motion.q.size() - first + step - 1) / step;
  auto const every = [&](Eigen::VectorXd const& signal) -> Eigen::VectorXd {
    return signal.size() == 0 ? signal : signal(Eigen::seqN(first, count, step)).eval();
  };
  return {motion.rate_hz / static_cast<double>(step),
          every(motion.time_s),
          every(motion.q),
          every(motion.dq),
          every(motion.ddq),
          every(motion.torque),
          motion.left_out,
          motion.left_out_because};
}

SampleRange samples_left_out(Stretch const& stretch, Eigen::Index n, double rate_hz, double cutoff_hz) {
  // what was filled is smooth: one period of the cut-off around it is enough, where three are at an end
  double const reach_s = cutoff_hz > 0.0 ? 1.0 / cutoff_hz : 0.0;
  auto const first = static_cast<Eigen::Index>(std::ceil((stretch.from_s - reach_s) * rate_hz));
  auto const last = static_cast<Eigen::Index>(std::floor((stretch.until_s + reach_s) * rate_hz));
  return {std::max<Eigen::Index>(0, first), std::min(n, last + 1)};
}

std::vector<bool> left_out_samples(Motion const& motion, double cutoff_hz) {
  auto const n = motion.time_s.size();
  std::vector<bool> left_out(static_cast<std::size_t>(n), false);
  for (auto const& stretch : motion.left_out) {
    auto const range = samples_left_out(stretch, n, motion.rate_hz, cutoff_hz);
    for (Eigen::Index k = range.first; k < range.end; ++k) left_out[static_cast<std::size_t>(k)] = true;
  }
  return left_out;
}

Motion differentiate(Recording&& recording, FilterOptions const& options, Section const& section) {
  TORQUESCOPE_EXPECT(recording.position.size() == recording.torque.size());
  check_cutoff("cutoff_hz", options.cutoff_hz, recording.rate_hz, section);
  check_source_rates(options, recording.rows, section);
  check_length(options, recording.position.size(), recording.rate_hz);
  for (Eigen::VectorXd* channel : {&recording.position, &recording.velocity, &recording.acceleration})
    if (channel->size() > 0 && options.cutoff_hz > 0) *channel = smooth_positions(*channel, options, recording.rate_hz);
  return differentiate_smooth(std::move(recording));
}

Motion differentiate(Recording const& recording, FilterOptions const& options, Section const& section) {
  Recording channels;
  channels.rate_hz = recording.rate_hz;
  channels.time_s = recording.time_s;
  channels.position = recording.position;
  channels.torque = recording.torque;
  channels.velocity = recording.velocity;
  channels.acceleration = recording.acceleration;
  channels.left_out = recording.left_out;
  channels.rows = recording.rows;
  channels.left_out_because = recording.left_out_because;
  return differentiate(std::move(channels), options, section);
}

}  // namespace torquescope
