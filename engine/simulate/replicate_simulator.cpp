#include "engine/simulate/replicate_simulator.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "engine/base/contract.hpp"
#include "engine/base/random_stream.hpp"
#include "engine/simulate/lane_controller.hpp"
#include "engine/simulate/lane_motion.hpp"
#include "engine/simulate/lane_noise.hpp"
#include "engine/simulate/sticking_lanes.hpp"

namespace torquescope {
namespace {

// Anywhere within the encoder's first step. Without it replicates of an undisturbed joint would all move alike: torque
// noise is only logged, and one pattern of rounding would pass for all there is.
void draw_starts(ReplicateAddress const& address, std::uint32_t group, ReplicateLoop const& loop,
                 ReplicateTrack const& track, double* position) {
  for (std::uint32_t lane = 0; lane < replicate_lanes; ++lane) {
    RandomStream random({address.seed, address.recording, RandomDomain::replicate},
                        stream_number(address, ReplicateStream::start),
                        group * static_cast<std::uint32_t>(replicate_lanes) + lane);
    position[lane] = track.start_position + loop.encoder_step * (random.uniform() - 0.5);
  }
}

// Where the encoder's steps lie is not known better than a step: what rounding makes of one motion is noise, not
// physics. With the steps in one place all replicates of an undisturbed joint would share nearly every reading, and one
// pattern of rounding would pass for all there is.
void draw_phases(ReplicateAddress const& address, std::uint32_t group, ReplicateLoop const& loop, double* phase) {
  for (std::uint32_t lane = 0; lane < replicate_lanes; ++lane) {
    RandomStream random({address.seed, address.recording, RandomDomain::replicate},
                        stream_number(address, ReplicateStream::phase),
                        group * static_cast<std::uint32_t>(replicate_lanes) + lane);
    phase[lane] = loop.encoder_step * (random.uniform() - 0.5);
  }
}

// The recording's first position is what the encoder read: a joint whose readings are off begins where it would read
// that. Otherwise the controller sees the whole error arrive in one tick
void read_as_recorded(ReplicateJoint const& joint, LaneInstant const& start, double* position) {
  alignas(64) double read[replicate_lanes];
  std::copy_n(position, replicate_lanes, read);
  for (auto const& make : joint.effects) make()->shift_position(start, read);
  for (std::size_t lane = 0; lane < replicate_lanes; ++lane) position[lane] -= read[lane] - position[lane];
}

void read_encoder(double step, double const* phase, double* position) {
  if (step == 0.0) return;
  for (std::size_t lane = 0; lane < replicate_lanes; ++lane)
    position[lane] = step * std::floor((position[lane] + phase[lane]) / step + 0.5) - phase[lane];
}

// The longest step between two changes of the torque. An effect with a memory, or sticking, is as quick as
// the caller knows. The joint alone decays at viscous / inertia and swings at sqrt(gravity / inertia): at a fiftieth of
// that time what the second order leaves out, a sixth of the square, is 7e-5
double longest_step_s(ReplicateJoint const& joint, StickingRange const& sticking, double step_s, double tick_s) {
  auto const has_memory = [](LaneEffectMaker const& make) { return make()->follows_steps(); };
  if (sticking.is_any() || std::any_of(joint.effects.begin(), joint.effects.end(), has_memory)) return step_s;
  constexpr double fiftieth = 0.02;
  LaneJoint const& own = joint.lanes;
  double const decay = std::abs(own.viscous) / own.inertia;
  double const swing =
      std::sqrt(std::sqrt(own.gravity_sin * own.gravity_sin + own.gravity_cos * own.gravity_cos) / own.inertia);
  return std::clamp(fiftieth / std::max({decay, swing, fiftieth / tick_s}), std::min(step_s, tick_s), tick_s);
}

// Steps for which an effect without memory is held. Beside it stands a viscous torque that is not: where both are
// large and cancel, as fits of a power of the speed near 1 have them, that moves the acceleration by (viscous held /
// inertia)^2 / 12, at a tenth by a thousandth. A tick, if it is short enough
std::size_t steps_held(LaneJoint const& joint, double step_s, std::size_t steps_per_tick) {
  constexpr double tenth = 0.1;
  double const most = tenth * joint.inertia / (std::abs(joint.viscous) * step_s);
  return most < static_cast<double>(steps_per_tick) ? static_cast<std::size_t>(std::max(1.0, most)) : steps_per_tick;
}

}  // namespace

ReplicateSimulator::ReplicateSimulator(ReplicateJoint joint, ReplicateLoop loop, ReplicateTrack track, double step_s)
    : joint_(std::move(joint)), loop_(std::move(loop)), track_(std::move(track)), asked_step_s_(step_s) {
  Eigen::Index const n = track_.reference.size();
  TORQUESCOPE_EXPECT(n > 0 && track_.rate_hz > 0.0 && step_s > 0.0 && !loop_.controller.position.empty());
  double const longest_s = longest_step_s(joint_, loop_.sticking, step_s, 1.0 / track_.rate_hz);
  steps_per_tick_ = static_cast<std::size_t>(std::ceil(1.0 / (track_.rate_hz * longest_s) * (1.0 - 1e-9)));
  step_s_ = 1.0 / (track_.rate_hz * static_cast<double>(steps_per_tick_));

  ReferenceSignal const reference(track_.reference);
  open_ = open_part(loop_.controller, track_.reference, track_.gear_load);
  if (track_.fed_forward.size() > 0) open_ += track_.fed_forward;
  wanted_.resize(n);
  for (Eigen::Index k = 0; k < n; ++k) wanted_[k] = reference(k + loop_.controller.shift);
}

void ReplicateSimulator::simulate(ReplicateAddress const& address, std::uint32_t group, ReplicateGroup& out) const {
  LaneNoise torque_noise(address, ReplicateStream::torque, group, loop_.torque_noise);
  LaneNoise slow_torque_noise(address, ReplicateStream::torque, group + second_half, loop_.slow_torque_noise);
  LaneLevels const torque_level(address, ReplicateStream::level, group + second_half, 1.0,
                                loop_.torque_noise_variance_error);
  LaneNoise disturbance(address, ReplicateStream::disturbance, group, white(1.0));
  LaneNoise position_noise(address, ReplicateStream::position, group, white(loop_.position_noise_std));
  LaneLevels const disturbance_std(address, ReplicateStream::level, group, loop_.disturbance_std,
                                   loop_.disturbance_variance_error);
  double encoder_phase[replicate_lanes];
  draw_phases(address, group, loop_, encoder_phase);
  LaneFriction friction(address, group, loop_, 1.0 / track_.rate_hz);
  LaneController controller(loop_.controller, track_.start_position, track_.start_velocity, track_.rate_hz);
  for (std::size_t lane = 0; lane < replicate_lanes; ++lane) {
    out.position[lane].resize(samples());
    out.torque[lane].resize(samples());
    out.ran_away[lane] = false;
  }

  LaneState state;
  draw_starts(address, group, loop_, track_, state.q);
  std::fill_n(state.dq, replicate_lanes, track_.start_velocity);
  LaneJoints const lanes = joint_.lanes;
  LaneSticking sticking;
  bool const sticks = loop_.sticking.is_any();
  if (sticks) draw_sticking(address, group, loop_.sticking, track_.start_velocity, sticking);
  LaneMotion motion({joint_.coulomb_forward, joint_.coulomb_backward}, joint_.effects,
                    {step_s_, steps_per_tick_, steps_held(joint_.lanes, step_s_, steps_per_tick_)});
  auto const& effects = motion.effects();
  alignas(64) double noise[replicate_lanes], measured[replicate_lanes], logged[replicate_lanes],
      command[replicate_lanes] = {};
  double const tick_s = 1.0 / track_.rate_hz;
  read_as_recorded(joint_, instant_of(state, 0.0, tick_s, command), state.q);
  for (Eigen::Index k = 0; k < samples(); ++k) {
    double const time_s = static_cast<double>(k) * tick_s;

    // measure and answer
    position_noise.next(noise);
    for (std::size_t lane = 0; lane < replicate_lanes; ++lane) measured[lane] = state.q[lane] + noise[lane];
    for (auto const& effect : effects) effect->shift_position(instant_of(state, time_s, tick_s, command), measured);
    if (loop_.sees_motion) controller.command(measured, open_[k], wanted_[k], command);
    read_encoder(loop_.encoder_step, encoder_phase, measured);
    if (!loop_.sees_motion) controller.command(measured, open_[k], wanted_[k], command);
    for (std::size_t lane = 0; lane < replicate_lanes; ++lane)
      // also true for a command that is no number
      if (!(std::abs(command[lane]) <= track_.largest_torque)) out.ran_away[lane] = true;
    if (track_.gear_load.size() > 0)
      for (double& own : command) own -= track_.gear_load[k];

    // log
    torque_noise.next(logged);
    if (loop_.slow_torque_noise.std > 0.0) {
      slow_torque_noise.next(noise);
      for (std::size_t lane = 0; lane < replicate_lanes; ++lane) logged[lane] += noise[lane];
    }
    if (loop_.torque_noise_variance_error > 0.0)
      for (std::size_t lane = 0; lane < replicate_lanes; ++lane) logged[lane] *= torque_level[lane];
    for (std::size_t lane = 0; lane < replicate_lanes; ++lane) logged[lane] += command[lane];
    for (auto const& effect : effects) effect->shift_torque(instant_of(state, time_s, tick_s, command), logged);
    for (std::size_t lane = 0; lane < replicate_lanes; ++lane) {
      out.position[lane][k] = measured[lane];
      out.torque[lane][k] = logged[lane];
    }

    // move on to the next tick
    friction.next();
    if (disturbance_std.is_any()) {
      disturbance.next(noise);
    } else {
      std::fill_n(noise, replicate_lanes, 0.0);
    }
    for (std::size_t lane = 0; lane < replicate_lanes; ++lane)
      noise[lane] = command[lane] + disturbance_std[lane] * noise[lane] - joint_.offset;
    motion.advance_tick(lanes, time_s, command, noise, friction.level(), sticks ? &sticking : nullptr, state);
  }
}

}  // namespace torquescope
