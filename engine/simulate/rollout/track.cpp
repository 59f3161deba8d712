#include "engine/simulate/rollout/track.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "engine/base/dense_solvers.hpp"
#include "engine/base/error.hpp"
#include "engine/data/encoder_step.hpp"

namespace torquescope {
namespace {

constexpr Eigen::Index fewest_samples = 8;
constexpr double most_ticks_per_sample = 200.0;  // below chunk_ticks of loop_lanes.hpp

// Slope at `at` of the parabola through the samples around it, none of them before `first`: a joint that starts changes
// its speed at once. Of a line where the bend is lost in the steps of the encoder; rest where the way is
double velocity_at(RolloutTrack const& track, Eigen::Index first, Eigen::Index at, Eigen::Index end) {
  constexpr double seconds = 0.02;
  auto const reach = std::max<Eigen::Index>(2, std::llround(0.5 * seconds * track.rate_hz));
  Eigen::Index const from = std::max(first, at - reach), until = std::min(end, std::max(at + reach, from + 4));
  Eigen::Index const n = until - from;
  if (n < 3) return 0.0;
  Eigen::MatrixXd powers(n, 3);
  powers.col(0).setOnes();
  for (Eigen::Index k = 0; k < n; ++k) powers(k, 1) = static_cast<double>(from + k - at);
  powers.col(2) = powers.col(1).cwiseProduct(powers.col(1));
  Eigen::VectorXd const q = track.position.segment(from, n);
  auto const line = solve_pivoted(powers.leftCols(2), q), parabola = solve_pivoted(powers, q);
  double const half = 0.5 * static_cast<double>(n - 1), bend = std::abs(parabola[2]) * half * half;
  if (std::abs(line[1]) * static_cast<double>(n - 1) <= track.encoder_step && bend <= track.encoder_step) return 0.0;
  return (bend > track.encoder_step ? parabola[1] : line[1]) * track.rate_hz;
}

// runs of samples outside every stretch that was left out
std::vector<TrackSegment> runs_of(Recording const& recording, Eigen::Index n) {
  std::vector<bool> is_out(static_cast<std::size_t>(n), false);
  for (auto const& stretch : recording.left_out)
    for (Eigen::Index k = 0; k < n; ++k) {
      double const time_s = static_cast<double>(k) / recording.rate_hz;
      if (time_s > stretch.from_s && time_s < stretch.until_s) is_out[static_cast<std::size_t>(k)] = true;
    }
  std::vector<TrackSegment> runs;
  for (Eigen::Index k = 0; k < n; ++k) {
    if (is_out[static_cast<std::size_t>(k)]) continue;
    bool const goes_on = k > 0 && !is_out[static_cast<std::size_t>(k - 1)];
    if (!goes_on) runs.push_back({k, 0});
    ++runs.back().samples;
  }
  std::erase_if(runs, [](TrackSegment const& run) { return run.samples < fewest_samples; });
  return runs;
}

std::vector<TrackSegment> in_windows(std::vector<TrackSegment> const& runs, Eigen::Index length) {
  std::vector<TrackSegment> windows;
  for (auto const& run : runs)
    for (Eigen::Index first = run.first; first < run.first + run.samples; first += length)
      windows.push_back({first, std::min(length, run.first + run.samples - first)});
  return windows;
}

// a segment of a run begins in the state that the recording measured there
TrackSegment begun(TrackSegment segment, RolloutTrack const& track, TrackSegment const& run, bool has_torque) {
  Eigen::Index const at = segment.first - segment.settling;
  segment.position = track.position[at];
  segment.velocity = velocity_at(track, run.first, at, run.first + run.samples);
  segment.torque = has_torque ? track.torque[std::max(at - 1, run.first)] : std::numeric_limits<double>::quiet_NaN();
  return segment;
}

}  // namespace

Eigen::Index RolloutTrack::samples() const {
  Eigen::Index sum = 0;
  for (auto const& segment : segments) sum += segment.samples;
  return sum;
}

Eigen::VectorXd untold_positions(RolloutTrack const& track) {
  bool const in_windows = track.drive == TrackDrive::torque && track.segments.size() > 1;
  if (!in_windows) {
    double sum = 0.0;
    for (auto const& segment : track.segments) sum += track.position.segment(segment.first, segment.samples).sum();
    return (track.position.array() - sum / static_cast<double>(track.samples())).matrix();
  }
  Eigen::VectorXd untold = Eigen::VectorXd::Zero(track.position.size());
  for (auto const& segment : track.segments)
    for (Eigen::Index k = 0; k < segment.samples; ++k)
      untold[segment.first + k] = track.position[segment.first + k] - segment.position -
                                  segment.velocity * static_cast<double>(k) / track.rate_hz;
  return untold;
}

RolloutTrack track_of(Recording const& recording, TrackOptions const& options) {
  RolloutTrack track;
  Eigen::Index const n = recording.position.size();
  track.name = recording.name;
  track.rate_hz = recording.rate_hz;
  track.drive = recording.reference.size() == n ? TrackDrive::reference : TrackDrive::torque;
  track.straight_reference = options.straight_reference;
  validate(options.controller_rate_hz <= most_ticks_per_sample * recording.rate_hz, [&] {
    Problem problem{ExitCode::bad_job,
                    fmt::format("loop.rate_hz = {:g} is more than {:g} times the {:g} Hz of {}",
                                options.controller_rate_hz, most_ticks_per_sample, recording.rate_hz, recording.name)};
    problem.help = "a lower rate says the same: 1000 Hz is enough for most joints";
    return problem;
  });
  if (options.controller_rate_hz > recording.rate_hz)
    track.ticks_per_sample =
        static_cast<std::size_t>(std::max(1.0, options.controller_rate_hz / recording.rate_hz + 0.5));
  track.encoder_step = encoder_step(recording);
  track.time_s = recording.time_s;
  track.reference = recording.reference;
  track.position = recording.position;
  track.torque = recording.torque;
  track.added = track.drive == TrackDrive::torque ? recording.torque : recording.added_command;
  track.outside = recording.external_torque;
  track.enabled = recording.enabled;
  auto const runs = runs_of(recording, n);
  validate(!runs.empty(), [&] {
    Problem problem{ExitCode::bad_data, fmt::format("{} has no {} samples in a row that could be simulated",
                                                    recording.name, fewest_samples)};
    problem.help = "leave less of it out (recording.leave_out), or record a stretch without gaps";
    return problem;
  });
  bool const is_open = track.drive == TrackDrive::torque && options.window_s > 0.0;
  auto const window = std::max<Eigen::Index>(fewest_samples / 2, std::llround(options.window_s * track.rate_hz));
  track.segments = is_open ? in_windows(runs, window) : runs;
  for (auto& segment : track.segments) {
    auto const run =
        std::find_if(runs.rbegin(), runs.rend(), [&](auto const& one) { return one.first <= segment.first; });
    segment = begun(segment, track, *run, options.has_torque);
  }
  return track;
}

RolloutTrack in_stretches(RolloutTrack track, Eigen::Index most) {
  // the first begins with the track, the last ends with it
  constexpr Eigen::Index stretches = 4, settling_share = 4;
  Eigen::Index const all = track.samples(), length = std::max(fewest_samples, most / stretches);
  if (all <= std::max(most, stretches * length)) return track;
  std::vector<TrackSegment> const runs = std::exchange(track.segments, {});
  for (Eigen::Index i = 0; i < stretches; ++i) {
    Eigen::Index const begin = i * (all - length) / (stretches - 1);
    Eigen::Index before = 0;  // samples of the runs before
    for (auto const& run : runs) {
      Eigen::Index const from = std::max(begin - before, Eigen::Index{0});
      Eigen::Index const until = std::min(begin + length - before, run.samples);
      TrackSegment one{run.first + from, until - from};
      one.settling = std::min(from, length / settling_share);
      if (one.samples >= fewest_samples) track.segments.push_back(begun(one, track, run, !std::isnan(run.torque)));
      before += run.samples;
    }
  }
  return track;
}

}  // namespace torquescope
