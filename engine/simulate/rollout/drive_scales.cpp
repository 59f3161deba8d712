#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/simulate/rollout/drive_effect.hpp"
#include "engine/simulate/rollout/measured_drive.hpp"

namespace torquescope {
namespace {

using Eigen::Index;

// share of the positive numbers below it
double quantile(std::vector<double> values, double share) {
  std::erase_if(values, [](double one) { return !(one > 0.0) || !std::isfinite(one); });
  if (values.empty()) return 0.0;
  auto const place = static_cast<std::size_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(place), values.end());
  return values[place];
}

void add_sizes(Eigen::VectorXd const& values, std::vector<double>& sizes) {
  for (double const value : values) sizes.push_back(std::abs(value));
}

// more than a tenth apart
bool differ(double least, double most) { return most > 0.0 && most - least > 0.1 * most; }

}  // namespace

DriveScales drive_scales(std::vector<RolloutTrack> const& tracks, LoopNumbers const& loop, bool fits_weight) {
  constexpr double nearly_all = 0.98;
  constexpr double infinite = std::numeric_limits<double>::infinity();
  DriveScales scales;
  std::vector<double> speeds, accelerations;
  double least_load = infinite, most_load = 0.0, coldest = infinite, hottest = -infinite;
  double errors = 0.0, commands = 0.0, torques = 0.0, samples = 0.0, arm = 0.0;
  scales.sample_s = infinite;
  for (auto const& track : tracks) {
    MeasuredDrive const drive = measured_drive(track, loop);
    add_sizes(drive.speed, speeds);
    add_sizes(drive.acceleration, accelerations);
    scales.sample_s = std::min(scales.sample_s, 1.0 / track.rate_hz);
    scales.encoder_step = std::max(scales.encoder_step, track.encoder_step);
    TrackKnown const& known = track.known;
    least_load = std::min(least_load, known.gravity_moment);
    most_load = std::max(most_load, known.gravity_moment);
    arm = std::max(arm, known.arm_length);
    coldest = std::fmin(coldest, known.temperature);
    hottest = std::fmax(hottest, known.temperature);
    if (track.reference.size() != track.position.size()) continue;
    for (Index k = 0; k < track.position.size(); ++k) {
      if (!is_drive_on(track, k)) continue;
      double const error = track.reference[k] - track.position[k], command = drive.command[k];
      errors += error * error;
      commands += command * command;
      torques += loop.motor_gain * command * loop.motor_gain * command;
      samples += 1.0;
    }
  }
  scales.speed = quantile(std::move(speeds), nearly_all);
  scales.acceleration = quantile(std::move(accelerations), nearly_all);
  if (samples > 0.0) {
    scales.error = std::sqrt(errors / samples);
    scales.command = std::sqrt(commands / samples);
    scales.torque = std::sqrt(torques / samples);
  }
  scales.has_load = most_load > 0.0 || fits_weight;
  scales.has_several_loads = differ(least_load, most_load);
  scales.has_arm = arm > 0.0 && scales.has_several_loads;
  scales.has_temperatures = hottest - coldest > 1.0;
  return scales;
}

}  // namespace torquescope
