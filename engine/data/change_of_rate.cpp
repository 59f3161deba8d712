#include "engine/data/change_of_rate.hpp"

#include <cmath>
#include <span>
#include <utility>
#include <vector>

#include "engine/data/resample.hpp"
#include "engine/data/zero_phase.hpp"

namespace torquescope {

Recording at_rate(Recording recording, double rate_hz) {
  constexpr double about_the_same = 0.9, below_new_rate = 0.4;
  constexpr int order = 4;
  auto const n = recording.position.size();
  double const old_hz = recording.rate_hz, duration_s = static_cast<double>(n - 1) / old_hz;
  std::vector<double> times, queries;
  for (Eigen::Index k = 0; k < n; ++k) times.push_back(static_cast<double>(k) / old_hz);
  for (double k = 0; k / rate_hz <= duration_s; ++k) queries.push_back(k / rate_hz);
  auto const changed = [&](Eigen::VectorXd const& channel) -> Eigen::VectorXd {
    if (channel.size() == 0) return channel;
    Eigen::VectorXd smooth = channel;
    if (rate_hz < about_the_same * old_hz)
      smooth = zero_phase_columns(butterworth_lowpass(order, below_new_rate * rate_hz, old_hz), channel).col(0);
    auto const found = interpolate(times, {smooth.data(), static_cast<std::size_t>(n)}, queries);
    return Eigen::Map<Eigen::VectorXd const>(found.data(), static_cast<Eigen::Index>(found.size()));
  };
  double const first_s = recording.time_s.size() > 0 ? recording.time_s[0] : 0.0;
  for (auto* channel : {&recording.position, &recording.torque, &recording.reference, &recording.velocity,
                        &recording.acceleration, &recording.simulated_torque, &recording.simulated_position,
                        &recording.added_command, &recording.external_torque, &recording.enabled})
    *channel = changed(*channel);
  constexpr double half = 0.5;
  if (recording.enabled.size() > 0) recording.enabled = (recording.enabled.array() > half).cast<double>();
  Eigen::MatrixXd others(static_cast<Eigen::Index>(queries.size()), recording.other_positions.cols());
  for (Eigen::Index c = 0; c < others.cols(); ++c) others.col(c) = changed(recording.other_positions.col(c));
  recording.other_positions = std::move(others);
  recording.time_s =
      Eigen::Map<Eigen::VectorXd const>(queries.data(), static_cast<Eigen::Index>(queries.size())).array() + first_s;
  recording.rate_hz = rate_hz;
  return recording;
}

}  // namespace torquescope
