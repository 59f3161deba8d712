#include "engine/simulate/rollout/rollout.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "engine/base/contract.hpp"
#include "engine/simulate/lane_controller.hpp"
#include "engine/simulate/lane_effect.hpp"
#include "engine/simulate/lane_motion.hpp"
#include "engine/simulate/rollout/chunk_inputs.hpp"
#include "engine/simulate/rollout/loop_lanes.hpp"
#include "kernels/aligned_doubles.hpp"

namespace torquescope {
namespace {

constexpr double no_number = std::numeric_limits<double>::quiet_NaN();

// Where the recorded torque drives the joint there is no controller, whatever led other recordings: it was answered and
// limited already
LoopNumbers loop_on(RolloutTrack const& track, LoopNumbers loop) {
  if (track.drive == TrackDrive::reference) return loop;
  LoopNumbers const none;
  loop.kp = loop.kd = loop.ki = loop.ki_speed = loop.feed_speed = loop.feed_acceleration = 0.0;
  loop.added_gain = none.added_gain;
  loop.least = none.least;
  loop.most = none.most;
  return loop;
}

// with what is known of the recording: a bar of the arm's mass turns about its end
RolloutTrial on_track(RolloutTrack const& track, RolloutTrial trial) {
  TrackKnown const& known = track.known;
  constexpr double gravity = 9.80665, warm_room = 25.0;
  double const arm_moment = trial.arm_mass * known.arm_length;
  trial.joint.inertia += known.inertia + arm_moment * known.arm_length / 3.0;
  trial.joint.gravity_sin += known.gravity_moment + 0.5 * gravity * arm_moment;
  trial.loop = loop_on(track, trial.loop);
  if (track.drive == TrackDrive::reference) {
    for (double* gain : {&trial.loop.kp, &trial.loop.kd, &trial.loop.ki, &trial.loop.ki_speed})
      *gain *= known.command_gain;
    trial.loop.most = std::min(trial.loop.most, known.command_limit);
    trial.loop.least = std::max(trial.loop.least, -known.command_limit);
  }
  if (std::isfinite(known.temperature))
    trial.loop.motor_gain *= 1.0 + trial.motor_gain_per_kelvin * (known.temperature - warm_room);
  return trial;
}

// sixteen trials as lanes; those beyond the last repeat the first
class Lanes {
 public:
  Lanes(RolloutTrack const& track, RolloutStructure const& structure, std::span<RolloutTrial const> trials)
      : has_controller_(track.controller.has_value()),
        loops(track.tick_s(), structure.hold_ticks, structure.speed_samples) {
    std::vector<Eigen::ArrayXXd> parameters;
    for (auto const& values : trials.front().effects)
      parameters.emplace_back(static_cast<Eigen::Index>(replicate_lanes), static_cast<Eigen::Index>(values.size()));
    for (std::size_t lane = 0; lane < replicate_lanes; ++lane) {
      used.push_back(on_track(track, trials[lane < trials.size() ? lane : 0]));
      RolloutTrial const& trial = used.back();
      rolled.joints.set(lane, trial.joint);
      rolled.dry.forward[lane] = trial.forward;
      rolled.dry.backward[lane] = trial.backward;
      rolled.offset[lane] = trial.offset;
      rolled.gears.set(lane, trial.gear);
      loops.set(lane, trial.loop);
      loops.set_encoder(lane, trial.encoder_step, trial.encoder_phase);
      delay_ticks.push_back(trial.loop.command_delay_s / track.tick_s());
      for (std::size_t e = 0; e < parameters.size(); ++e)
        for (std::size_t k = 0; k < trial.effects[e].size(); ++k)
          parameters[e](static_cast<Eigen::Index>(lane), static_cast<Eigen::Index>(k)) = trial.effects[e][k];
    }
    LaneBaseline beside;
    beside.joint = rolled.joints;
    for (std::size_t e = 0; e < parameters.size(); ++e)
      makers.push_back(lane_effect_of_each(*structure.effects[e], parameters[e], structure.scales, beside));
    double const longest_s = std::min(structure.step_s, track.tick_s());
    steps = static_cast<std::size_t>(std::ceil(track.tick_s() / longest_s * (1.0 - 1e-9)));
    braked = rolled.joints;
    for (std::size_t lane = 0; lane < replicate_lanes; ++lane) braked.viscous[lane] += loops.back_emf[lane];
  }

  bool is_fast() const { return makers.empty() && !has_controller_; }

  void read_encoder(double* position) const {
    if (!loops.has_encoder) return;
    for (std::size_t lane = 0; lane < replicate_lanes; ++lane) {
      double const step = used[lane].encoder_step, phase = used[lane].encoder_phase;
      if (step > 0.0) position[lane] = step * std::floor((position[lane] + phase) / step + 0.5) - phase;
    }
  }

 private:
  bool has_controller_;

 public:
  LaneLoops loops;
  RolledJoints rolled{};
  LaneJoints braked{};  // with the back-EMF of a drive that is on
  std::vector<RolloutTrial> used{};
  std::vector<double> delay_ticks{};
  std::vector<LaneEffectMaker> makers{};
  std::size_t steps = 1;
};

struct Chunk {
  kernels::AlignedDoubles position = kernels::AlignedDoubles(chunk_ticks * replicate_lanes),
                          velocity = kernels::AlignedDoubles(chunk_ticks * replicate_lanes),
                          torque = kernels::AlignedDoubles(chunk_ticks * replicate_lanes);
  TickOutputs outputs() { return {position.data(), velocity.data(), torque.data()}; }
};

// what has no memory is held for a millisecond at most
TickSteps tick_steps(double tick_s, std::size_t steps) {
  constexpr double longest_held_s = 1e-3;
  double const step_s = tick_s / static_cast<double>(steps);
  return {step_s, steps, std::clamp<std::size_t>(static_cast<std::size_t>(longest_held_s / step_s), 1, steps)};
}

// one segment, tick by tick: effects, an identified controller
class SlowSegment {
 public:
  SlowSegment(RolloutTrack const& track, TrackSegment const& segment, Lanes const& lanes)
      : track_(track),
        lanes_(lanes),
        start_s_(track.time_s.size() > 0 ? track.time_s[segment.first]
                                         : static_cast<double>(segment.first) / track.rate_hz),
        motion_(lanes.rolled.dry, lanes.makers, tick_steps(track.tick_s(), lanes.steps)) {
    for (auto const& effect : motion_.effects()) shifts_channels_ = shifts_channels_ || effect->shifts_channels();
    if (!track.controller) return;
    controller_.emplace(*track.controller, segment.position, segment.velocity, track.rate_hz);
    Eigen::VectorXd const reference = track.reference.segment(segment.first, segment.samples);
    open_ = open_part(*track.controller, reference);
    ReferenceSignal const signal(reference);
    wanted_.resize(segment.samples);
    for (Eigen::Index k = 0; k < segment.samples; ++k) wanted_[k] = signal(k + track.controller->shift);
  }

  void roll(TickInputs const& inputs, std::size_t first_tick, std::size_t ticks, LaneState& state, LaneLoopState& loop,
            TickOutputs const& out) {
    alignas(64) double read[replicate_lanes], held[replicate_lanes], logged[replicate_lanes], acts[replicate_lanes];
    for (std::size_t row = 0; row < ticks; ++row) {
      double const time_s = start_s_ + static_cast<double>(first_tick + row) * track_.tick_s();
      std::copy_n(state.q, replicate_lanes, read);
      if (shifts_channels_) {
        LaneInstant const at = instant_of(state, time_s, track_.tick_s(), motor_);
        for (auto const& effect : motion_.effects()) effect->shift_position(at, read);
      }
      lanes_.read_encoder(read);
      answer(inputs, first_tick, row, read, state.dq, loop, held, logged);
      std::copy_n(held, replicate_lanes, motor_);
      if (shifts_channels_) {
        LaneInstant const answered = instant_of(state, time_s, track_.tick_s(), motor_);
        for (auto const& effect : motion_.effects()) effect->shift_torque(answered, logged);
      }
      std::copy_n(read, replicate_lanes, out.position + row * replicate_lanes);
      std::copy_n(state.dq, replicate_lanes, out.velocity + row * replicate_lanes);
      std::copy_n(logged, replicate_lanes, out.torque + row * replicate_lanes);
      double const outside = inputs.outside != nullptr ? inputs.outside[row] : 0.0;
      for (std::size_t lane = 0; lane < replicate_lanes; ++lane)
        acts[lane] = held[lane] - lanes_.rolled.offset[lane] + outside;
      bool const is_on = inputs.enabled == nullptr || inputs.enabled[row] != 0.0;
      if (lanes_.rolled.gears.any) rub_gears(is_on, state);
      motion_.advance_tick(is_on ? lanes_.braked : lanes_.rolled.joints, time_s, motor_, acts, ones_, nullptr, state);
    }
  }

 private:
  void answer(TickInputs const& inputs, std::size_t first_tick, std::size_t row, double const* read,
              double const* speed, LaneLoopState& loop, double* held, double* logged) {
    if (!controller_) return answer_tick(lanes_.loops, inputs, row, read, speed, loop, held, logged);
    // the controller answers once a sample: it was found in samples
    std::size_t const tick = first_tick + row;
    auto const k = static_cast<Eigen::Index>(tick / track_.ticks_per_sample);
    if (tick % track_.ticks_per_sample == 0) controller_->command(read, open_[k], wanted_[k], command_);
    alignas(64) double whole[replicate_lanes];
    double const added = inputs.added != nullptr ? inputs.added[row] : 0.0;
    for (std::size_t lane = 0; lane < replicate_lanes; ++lane)
      whole[lane] = command_[lane] + lanes_.loops.added_gain[lane] * added;
    pass_on_tick(lanes_.loops, inputs, row, whole, loop, held, logged);
  }

  void rub_gears(bool is_on, LaneState const& state) {
    alignas(64) double motor[replicate_lanes], weight[replicate_lanes], friction[replicate_lanes];
    alignas(64) double sine[replicate_lanes], cosine[replicate_lanes];
    LaneJoints const& joints = lanes_.rolled.joints;
    LaneDryFriction dry = lanes_.rolled.dry;
    for (std::size_t lane = 0; lane < replicate_lanes; ++lane) {
      motor[lane] = motor_[lane] - (is_on ? lanes_.loops.back_emf[lane] * state.dq[lane] : 0.0);
      sine[lane] = std::sin(state.q[lane]);
      cosine[lane] = std::cos(state.q[lane]);
      weight[lane] = joints.gravity_sin[lane] * sine[lane] + joints.gravity_cos[lane] * cosine[lane];
    }
    gear_friction(lanes_.rolled.gears, motor, weight, state.dq, sine, cosine, friction);
    for (std::size_t lane = 0; lane < replicate_lanes; ++lane) {
      dry.forward[lane] = std::max(dry.forward[lane] + friction[lane], 0.0);
      dry.backward[lane] = std::min(dry.backward[lane] - friction[lane], 0.0);
    }
    motion_.set_dry_friction(dry);
  }

  RolloutTrack const& track_;
  Lanes const& lanes_;
  double start_s_;  // by the recording's clock, as effects of the time see it
  LaneMotion motion_;
  bool shifts_channels_ = false;
  std::optional<LaneController> controller_{};
  Eigen::VectorXd open_{}, wanted_{};
  alignas(64) double motor_[replicate_lanes] = {}, command_[replicate_lanes] = {};
  double ones_[replicate_lanes] = {1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1};
};

// lanes that are lost stay so
class Watch {
 public:
  Watch(RolloutTrack const& track, TrackSegment const& segment, std::span<RolloutTrial const> trials) {
    constexpr double far_times = 100.0;
    middle_ = 0.5 * (track.position.maxCoeff() + track.position.minCoeff());
    double const range = track.position.maxCoeff() - track.position.minCoeff();
    farthest_ = far_times * std::max({range, std::abs(segment.velocity) / track.rate_hz, 1e-3});
    for (std::size_t lane = 0; lane < replicate_lanes; ++lane)
      is_lost_[lane] = lane < trials.size() && !trials[lane].is_possible;
  }

  void look(Chunk& chunk, std::size_t ticks, LaneState& state) {
    for (std::size_t lane = 0; lane < replicate_lanes; ++lane) {
      // what leaves for so far does not come back within a chunk
      if (!(std::abs(chunk.position[(ticks - 1) * replicate_lanes + lane] - middle_) < farthest_))
        is_lost_[lane] = true;
      if (!is_lost_[lane]) continue;
      state.q[lane] = middle_;  // out of the way: no overflow slows the others down
      state.dq[lane] = state.ddq[lane] = 0.0;
      for (std::size_t row = 0; row < ticks; ++row)
        for (auto* values : {&chunk.position, &chunk.velocity, &chunk.torque})
          (*values)[row * replicate_lanes + lane] = no_number;
    }
  }

  bool all_lost(std::size_t trials) const {
    return std::all_of(is_lost_, is_lost_ + trials, [](bool lost) { return lost; });
  }

 private:
  double middle_ = 0.0, farthest_ = 0.0;
  bool is_lost_[replicate_lanes] = {};
};

// rows of ticks become rows of samples, in place
void keep_samples(kernels::AlignedDoubles& rows, std::size_t samples, std::size_t ticks_per_sample) {
  if (ticks_per_sample == 1) return;
  for (std::size_t k = 1; k < samples; ++k)
    std::copy_n(rows.begin() + static_cast<std::ptrdiff_t>(k * ticks_per_sample * replicate_lanes), replicate_lanes,
                rows.begin() + static_cast<std::ptrdiff_t>(k * replicate_lanes));
}

// whole samples, and for a weight few enough that its angle's series holds
std::size_t ticks_of_chunk(RolloutTrack const& track, bool has_weight) {
  std::size_t const each = track.ticks_per_sample;
  std::size_t whole = std::max<std::size_t>(1, chunk_ticks / each) * each;
  if (!has_weight) return whole;
  double fastest = 0.0;
  for (Eigen::Index k = 1; k < track.position.size(); ++k)
    fastest = std::max(fastest, std::abs(track.position[k] - track.position[k - 1]));
  constexpr double small_turn = 0.02, medium_turn = 0.1;
  double const turn = fastest / static_cast<double>(each);
  if (turn > small_turn) whole = std::max<std::size_t>(1, (turn > medium_turn ? 1 : 16) / each) * each;
  return whole;
}

// what has settled of rows [first, first + samples)
void tell_settled(TrackSegment const& segment, Eigen::Index first, Eigen::Index samples, Chunk const& chunk,
                  RolloutSink const& sink) {
  Eigen::Index const skipped = std::clamp<Eigen::Index>(segment.first - first, 0, samples);
  std::ptrdiff_t const at = skipped * static_cast<std::ptrdiff_t>(replicate_lanes);
  if (skipped < samples)
    sink({first + skipped, samples - skipped, chunk.position.data() + at, chunk.velocity.data() + at,
          chunk.torque.data() + at});
}

void roll_segment(RolloutTrack const& track, TrackSegment const& compared, Lanes const& lanes,
                  std::span<RolloutTrial const> trials, Chunk& chunk, RolloutSink const& sink) {
  TrackSegment segment = compared;
  segment.first -= compared.settling;
  segment.samples += compared.settling;
  ChunkInputs inputs(track, segment, lanes.delay_ticks);
  LaneState state;
  for (std::size_t lane = 0; lane < replicate_lanes; ++lane) {
    state.q[lane] = segment.position + lanes.used[lane].position_step;
    state.dq[lane] = segment.velocity + lanes.used[lane].velocity_step;
  }
  LaneLoopState loop;
  double first_goal[replicate_lanes];
  for (std::size_t lane = 0; lane < replicate_lanes; ++lane)
    first_goal[lane] = inputs.reference().at(-lanes.delay_ticks[lane]);
  loop.start(lanes.loops, state, first_goal, segment.torque);
  std::optional<SlowSegment> slow;
  if (!lanes.is_fast()) slow.emplace(track, segment, lanes);
  Watch watch(track, segment, trials);
  std::size_t const all = static_cast<std::size_t>(segment.samples) * track.ticks_per_sample;
  std::size_t const at_once = ticks_of_chunk(track, lanes.rolled.needs_angle() && lanes.is_fast());
  for (std::size_t first = 0; first < all; first += at_once) {
    std::size_t const ticks = std::min(at_once, all - first), samples = ticks / track.ticks_per_sample;
    if (!watch.all_lost(trials.size())) {
      TickInputs const in = inputs.at(first, ticks);
      if (slow)
        slow->roll(in, first, ticks, state, loop, chunk.outputs());
      else
        roll_ticks(lanes.rolled, lanes.loops, in, ticks, lanes.steps, state, loop, chunk.outputs());
    }
    watch.look(chunk, ticks, state);
    for (auto* rows : {&chunk.position, &chunk.velocity, &chunk.torque})
      keep_samples(*rows, samples, track.ticks_per_sample);
    tell_settled(compared, segment.first + static_cast<Eigen::Index>(first / track.ticks_per_sample),
                 static_cast<Eigen::Index>(samples), chunk, sink);
  }
}

}  // namespace

void roll_out(RolloutTrack const& track, RolloutStructure const& structure, std::span<RolloutTrial const> trials,
              RolloutSink const& sink) {
  TORQUESCOPE_EXPECT(!trials.empty() && trials.size() <= replicate_lanes && track.ticks_per_sample <= chunk_ticks);
  // a lane that cannot be simulated is given the first that can, and is lost from the start
  std::vector<RolloutTrial> possible(trials.begin(), trials.end());
  auto const first = std::find_if(trials.begin(), trials.end(), [](auto const& one) { return one.is_possible; });
  for (auto& trial : possible)
    if (!trial.is_possible && first != trials.end()) trial = *first;
  Lanes const lanes(track, structure, possible);
  Chunk chunk;
  for (auto const& segment : track.segments) roll_segment(track, segment, lanes, trials, chunk, sink);
}

double longest_step_s(RolloutTrial const& trial, RolloutStructure const& structure, double tick_s) {
  constexpr double fiftieth = 0.02, of_memory_s = 5e-4;
  double const inertia = trial.joint.inertia;
  if (!(inertia > 0.0)) return tick_s;
  double const decay = std::abs(trial.joint.viscous + trial.loop.back_emf) / inertia;
  double const sine = trial.joint.gravity_sin, cosine = trial.joint.gravity_cos;
  double const swing = std::sqrt(std::sqrt(sine * sine + cosine * cosine) / inertia);
  double const own = fiftieth / std::max({decay, swing, fiftieth / tick_s});
  bool const remembers = std::any_of(structure.effects.begin(), structure.effects.end(),
                                     [](Effect const* effect) { return effect->has_memory(); });
  constexpr double shortest_share = 1.0 / 64.0;
  return std::clamp(remembers ? std::min(own, of_memory_s) : own, shortest_share * tick_s, tick_s);
}

}  // namespace torquescope
