#include "engine/simulate/rollout/replay.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/base/random_stream.hpp"

namespace torquescope {
namespace {

using Eigen::Index;
constexpr double nan = std::numeric_limits<double>::quiet_NaN();

struct Simulated {
  std::array<Eigen::VectorXd, replay_channels> channels{};
};

Simulated simulate(RolloutTrack const& track, ReplayedModel const& model) {
  Simulated result;
  for (auto& channel : result.channels) channel = Eigen::VectorXd::Constant(track.position.size(), nan);
  roll_out(track, model.structure, {&model.trial, 1}, [&](RolloutRows const& rows) {
    std::array<double const*, replay_channels> const from{rows.position, rows.velocity, rows.torque};
    for (std::size_t c = 0; c < replay_channels; ++c)
      for (Index k = 0; k < rows.samples; ++k)
        result.channels[c][rows.first + k] = from[c][static_cast<std::size_t>(k) * replicate_lanes];
  });
  return result;
}

std::vector<bool> simulated_samples(RolloutTrack const& track) {
  std::vector<bool> is_in(static_cast<std::size_t>(track.position.size()), false);
  for (auto const& segment : track.segments) std::fill_n(is_in.begin() + segment.first, segment.samples, true);
  return is_in;
}

ChannelError error_of(Eigen::VectorXd const& measured, Eigen::VectorXd const& simulated, std::vector<bool> const& is_in,
                      double signal_rms) {
  ChannelError error;
  double squares = 0.0, sizes = 0.0;
  for (Index k = 0; k < measured.size(); ++k) {
    if (!is_in[static_cast<std::size_t>(k)]) continue;
    double const off = measured[k] - simulated[k];
    squares += off * off;
    sizes += std::abs(off);
    ++error.samples;
  }
  auto const n = static_cast<double>(error.samples);
  error.rms = std::sqrt(squares / n);
  error.mae = sizes / n;
  error.relerr = error.rms / signal_rms;
  return error;
}

double rms_of_signal(Eigen::VectorXd const& measured, std::vector<bool> const& is_in, bool about_mean) {
  double sum = 0.0, squares = 0.0, n = 0.0;
  for (Index k = 0; k < measured.size(); ++k) {
    if (!is_in[static_cast<std::size_t>(k)]) continue;
    sum += measured[k];
    n += 1.0;
  }
  double const mean = about_mean ? sum / n : 0.0;
  for (Index k = 0; k < measured.size(); ++k)
    if (is_in[static_cast<std::size_t>(k)]) squares += (measured[k] - mean) * (measured[k] - mean);
  return std::sqrt(squares / n);
}

// the same joint, whose encoder lies elsewhere and which begins elsewhere within its step
std::vector<RolloutTrial> replicates_of(RolloutTrial const& trial, double encoder_step) {
  std::vector<RolloutTrial> replicates(replicate_lanes, trial);
  for (std::uint32_t lane = 0; lane < replicate_lanes; ++lane) {
    RandomStream random({0, 0, RandomDomain::simulation}, 0, lane);
    replicates[lane].encoder_step = encoder_step;
    replicates[lane].encoder_phase = encoder_step * (random.uniform() - 0.5);
    replicates[lane].position_step = encoder_step * (random.uniform() - 0.5);
  }
  return replicates;
}

double horizon_of(RolloutTrack const& track, ReplayedModel const& model, Eigen::VectorXd const& simulated) {
  if (!(track.encoder_step > 0.0) || track.drive != TrackDrive::reference) return nan;
  constexpr double stretch_s = 0.5, two_steps = 2.0;
  auto const length = std::max<Index>(1, std::llround(stretch_s * track.rate_hz));
  Index const n = track.position.size(), stretches = (n + length - 1) / length;
  Eigen::VectorXd spread = Eigen::VectorXd::Zero(stretches), error = spread, count = spread;
  auto const replicates = replicates_of(model.trial, track.encoder_step);
  roll_out(track, model.structure, replicates, [&](RolloutRows const& rows) {
    for (Index k = 0; k < rows.samples; ++k) {
      double const* const q = rows.position + static_cast<std::size_t>(k) * replicate_lanes;
      double mean = 0.0, squares = 0.0;
      for (std::size_t lane = 0; lane < replicate_lanes; ++lane) mean += q[lane] / static_cast<double>(replicate_lanes);
      for (std::size_t lane = 0; lane < replicate_lanes; ++lane) squares += (q[lane] - mean) * (q[lane] - mean);
      Index const at = rows.first + k;
      double const off = track.position[at] - simulated[at];
      spread[at / length] += squares / static_cast<double>(replicate_lanes - 1);
      error[at / length] += off * off;
      count[at / length] += 1.0;
    }
  });
  for (Index i = 0; i < stretches; ++i) {
    double const least = two_steps * track.encoder_step;
    if (count[i] > 0.0 && spread[i] >= error[i] && spread[i] >= count[i] * least * least)
      return track.time_s[i * length];
  }
  return nan;
}

}  // namespace

std::string word(ReplayChannel channel) {
  switch (channel) {
    case ReplayChannel::position:
      return "position";
    case ReplayChannel::velocity:
      return "velocity";
    case ReplayChannel::torque:
      break;
  }
  return "torque";
}

RecordingReplay replay_recording(Recording const& recording, RolloutTrack const& track, Eigen::VectorXd const& velocity,
                                 std::vector<ReplayedModel> const& models) {
  RecordingReplay replay;
  replay.name = track.name;
  replay.drive = track.drive;
  replay.rate_hz = track.rate_hz;
  replay.time_s = track.time_s;
  auto const is_in = simulated_samples(track);
  bool const has_torque = track.drive == TrackDrive::reference;
  replay.channels[0].measured = track.position;
  replay.channels[1].measured = velocity;
  if (has_torque) replay.channels[2].measured = track.torque;
  std::vector<Simulated> all;
  for (auto const& model : models) all.push_back(simulate(track, model));
  if (recording.simulated_position.size() > 0 || recording.simulated_torque.size() > 0) {
    all.emplace_back();
    all.back().channels[0] = recording.simulated_position;
    all.back().channels[2] = recording.simulated_torque;
  }
  for (auto const& one : all) {
    auto const& q = one.channels[0];
    bool lost = false;
    for (Index k = 0; k < q.size(); ++k) lost = lost || (is_in[static_cast<std::size_t>(k)] && !std::isfinite(q[k]));
    replay.diverged.push_back(lost);
  }
  for (std::size_t c = 0; c < replay_channels; ++c) {
    auto& channel = replay.channels[c];
    if (channel.measured.size() == 0) continue;
    auto const which = static_cast<ReplayChannel>(c);
    channel.signal_rms = which == ReplayChannel::position
                             ? rms_of_signal(untold_positions(track), is_in, false)
                             : rms_of_signal(channel.measured, is_in, which == ReplayChannel::velocity);
    for (std::size_t m = 0; m < all.size(); ++m) {
      bool const says_it = all[m].channels[c].size() > 0;
      channel.simulated.push_back(says_it ? all[m].channels[c]
                                          : Eigen::VectorXd::Constant(channel.measured.size(), nan).eval());
      channel.errors.push_back(error_of(channel.measured, channel.simulated.back(), is_in, channel.signal_rms));
    }
  }
  replay.loop_error = nan;
  replay.horizon_s = nan;
  if (!models.empty() && !replay.diverged[models.size() - 1])
    replay.horizon_s = horizon_of(track, models.back(), all[models.size() - 1].channels[0]);
  return replay;
}

}  // namespace torquescope
