#include "engine/simulate/rollout/loop_lanes.hpp"

#include <cmath>

#include "kernels/dispatch-inl.hpp"
#include "kernels/elementary.hpp"

// the part up to HWY_ONCE is compiled once per instruction set
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "engine/simulate/rollout/loop_lanes.cpp"
#include "hwy/foreach_target.h"
#include "hwy/highway.h"

#include "engine/simulate/lane_sliding-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace torquescope::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

HWY_INLINE V load(double const* lanes, std::size_t lane) { return hn::Load(d, lanes + lane); }
HWY_INLINE void store(V value, double* lanes, std::size_t lane) { hn::Store(value, d, lanes + lane); }
HWY_INLINE V clamped(V value, V least, V most) { return hn::Max(least, hn::Min(most, value)); }

// a goal that may run at goal_step a tick and change that by goal_change: it brakes so as to arrive
HWY_INLINE V led_goal(LaneLoops const& loops, V wanted, LaneLoopState& loop, std::size_t lane) {
  V const goal = load(loop.goal, lane), most_step = load(loops.goal_step, lane);
  V const most_change = load(loops.goal_change, lane), before = load(loop.goal_speed, lane);
  V const way = hn::Sub(wanted, goal), zero = hn::Zero(d);
  // from the speed n change one stops after change n (n + 1) / 2: the largest n that does not pass the goal
  V const half = hn::Set(d, 0.5);
  V const changes = hn::Div(hn::Abs(way), most_change);
  V const braking = hn::Mul(most_change, hn::Sub(hn::Sqrt(hn::Add(hn::Add(changes, changes), hn::Set(d, 0.25))), half));
  M const is_free = hn::Eq(most_change, hn::Set(d, HUGE_VAL));
  V const size = hn::Min(hn::Min(hn::IfThenElse(is_free, hn::Abs(way), braking), hn::Abs(way)), most_step);
  V const target = hn::IfThenElse(hn::Lt(way, zero), hn::Neg(size), size);
  V const step = clamped(target, hn::Sub(before, most_change), hn::Add(before, most_change));
  V const chosen = hn::IfThenElse(is_free, target, step);
  store(chosen, loop.goal_speed, lane);
  // the whole way is no sum: a lane without limits sees its reference itself
  return hn::IfThenElse(hn::Eq(chosen, way), wanted, hn::Add(goal, chosen));
}

// the torque that was asked for late_ticks and a share of a tick ago, on average over the tick
HWY_INLINE V delayed(LaneLoops const& loops, LaneLoopState& loop, V command, std::size_t lane) {
  store(command, loop.commands[loop.clock.tick % most_delay_ticks], lane);
  alignas(64) double newer[vector_lanes], older[vector_lanes];
  for (std::size_t i = 0; i < vector_lanes; ++i) {
    std::size_t const at = loop.clock.tick + most_delay_ticks - loops.late_ticks[lane + i];
    newer[i] = loop.commands[at % most_delay_ticks][lane + i];
    older[i] = loop.commands[(at - 1) % most_delay_ticks][lane + i];
  }
  V const now = hn::Load(d, newer);
  return hn::Add(now, hn::Mul(load(loops.late_share, lane), hn::Sub(hn::Load(d, older), now)));
}

// a drive that takes a small error for none, and gives no less than its least drive for a larger one
HWY_INLINE V driven(LaneLoops const& loops, V error, V asked, std::size_t lane) {
  V const least = hn::Max(hn::Abs(asked), load(loops.punch, lane));
  V const driven = hn::IfThenElse(hn::Lt(asked, hn::Zero(d)), hn::Neg(least), least);
  M const is_quiet = hn::Or(hn::Le(hn::Abs(error), load(loops.dead_band, lane)), hn::Eq(asked, hn::Zero(d)));
  return hn::IfThenElseZero(hn::Not(is_quiet), driven);
}

// what the encoder shows
HWY_INLINE V read_by_steps(LaneLoops const& loops, V q, std::size_t lane) {
  V const step = load(loops.encoder_step, lane), phase = load(loops.encoder_phase, lane);
  M const has_steps = hn::Gt(step, hn::Zero(d));
  V const in_steps = hn::Div(hn::Add(q, phase), hn::IfThenElse(has_steps, step, hn::Set(d, 1.0)));
  V const shown = hn::Sub(hn::Mul(step, hn::Floor(hn::Add(in_steps, hn::Set(d, 0.5)))), phase);
  return hn::IfThenElse(has_steps, shown, q);
}

// gear_friction.hpp; motor, weight: torques
HWY_INLINE V friction_of_gear(LaneGears const& gears, V motor, V weight, V dq, V sine, V cosine, std::size_t lane) {
  V const one = hn::Set(d, 1.0);
  V const share = load(gears.motor_share, lane);
  V const load_torque = hn::Abs(hn::Add(weight, hn::Mul(share, hn::Sub(motor, weight))));
  V const turn = hn::Mul(dq, load(gears.per_speed, lane));
  V const width = hn::Add(one, hn::Mul(hn::Mul(turn, turn), hn::Set(d, 1.0 / 16.0)));
  V const square = hn::Mul(width, width), fourth = hn::Mul(square, square), eighth = hn::Mul(fourth, fourth);
  V const bell = hn::Div(one, hn::Mul(eighth, eighth));
  V const slow = hn::Add(load(gears.stribeck, lane), hn::Mul(load(gears.load_stribeck, lane), load_torque));
  V const loaded = hn::Add(load(gears.load, lane), hn::Mul(load(gears.load_square, lane), load_torque));
  V const still = hn::Add(hn::Mul(loaded, load_torque), hn::Mul(slow, bell));
  V const turning = hn::Add(hn::Mul(load(gears.angle_cos, lane), cosine), hn::Mul(load(gears.angle_sin, lane), sine));
  return hn::Add(still, turning);
}

void gear_friction_lanes(LaneGears const& gears, double const* motor, double const* weight, double const* speed,
                         double const* sine, double const* cosine, double* friction) {
  for (std::size_t lane = 0; lane < replicate_lanes; lane += vector_lanes)
    hn::StoreU(
        friction_of_gear(gears, hn::LoadU(d, motor + lane), hn::LoadU(d, weight + lane), hn::LoadU(d, speed + lane),
                         hn::LoadU(d, sine + lane), hn::LoadU(d, cosine + lane), lane),
        d, friction + lane);
}

// a command on its way to the motor: what acts on average until the next tick
HWY_INLINE V pass_on(LaneLoops const& loops, TickInputs const& in, std::size_t row, V command, LaneLoopState& loop,
                     std::size_t lane) {
  if (in.enabled != nullptr) command = hn::Mul(command, hn::Set(d, in.enabled[row]));
  V const logged_before = load(loop.logged, lane);
  store(hn::Add(logged_before, hn::Mul(load(loops.log_share, lane), hn::Sub(command, logged_before))), loop.logged,
        lane);
  V acting = loops.has_delay ? delayed(loops, loop, command, lane) : command;
  if (loops.has_lag) {
    V const lagging = hn::Sub(load(loop.lagged, lane), acting);
    store(hn::Add(acting, hn::Mul(lagging, load(loops.lag_end, lane))), loop.lagged, lane);
    acting = hn::Add(acting, hn::Mul(lagging, load(loops.lag_mean, lane)));
  }
  acting = hn::Mul(acting, load(loops.motor_gain, lane));
  if (in.enabled == nullptr) return acting;
  // whatever is on its way: a motor whose drive is off gives nothing
  V const is_on = hn::Set(d, in.enabled[row]);
  if (loops.has_lag) store(hn::Mul(load(loop.lagged, lane), is_on), loop.lagged, lane);
  return hn::Mul(acting, is_on);
}

// what the motor gives on average until the next tick
HWY_INLINE V answer(LaneLoops const& loops, TickInputs const& in, std::size_t row, V read, V dq, LaneLoopState& loop,
                    std::size_t lane) {
  V const wanted =
      in.goal_stride == 1 ? hn::Set(d, in.goal[row]) : hn::LoadU(d, in.goal + row * replicate_lanes + lane);
  V const goal = loops.has_profile ? led_goal(loops, wanted, loop, lane) : wanted;
  store(goal, loop.goal, lane);
  V command = load(loop.command, lane);
  if (loop.clock.answers()) {
    V const per_period = hn::Set(d, loops.per_period);
    V const error = hn::Sub(goal, read);
    V difference = dq;
    if (loops.speed_samples > 0) {
      double* const place = loop.reads[loop.clock.place];
      difference = hn::Mul(hn::Sub(read, load(place, lane)), hn::Set(d, loops.per_span));
      store(read, place, lane);
    }
    V speed = load(loop.speed, lane);
    speed = hn::Add(speed, hn::Mul(load(loops.speed_share, lane), hn::Sub(difference, speed)));
    store(speed, loop.speed, lane);
    V slip = hn::Neg(speed), ahead = hn::Zero(d);
    if (loops.has_feed) {
      V const goal_step = hn::Mul(hn::Sub(goal, load(loop.goal_before, lane)), per_period);
      V const change = hn::Mul(hn::Sub(goal_step, load(loop.goal_step_before, lane)), per_period);
      store(goal, loop.goal_before, lane);
      store(goal_step, loop.goal_step_before, lane);
      slip = hn::Add(slip, hn::Mul(load(loops.feed_speed, lane), goal_step));
      ahead = hn::Mul(load(loops.feed_acceleration, lane), change);
    }
    V asked = hn::Add(hn::Add(hn::Mul(load(loops.kp, lane), error), hn::Mul(load(loops.kd, lane), slip)), ahead);
    if (in.added != nullptr) asked = hn::Add(asked, hn::Mul(load(loops.added_gain, lane), hn::Set(d, in.added[row])));
    V const least = load(loops.least, lane), most = load(loops.most, lane);
    if (loops.has_integral) {
      V grown = hn::Mul(hn::Set(d, loops.period_s),
                        hn::Add(hn::Mul(load(loops.ki, lane), error), hn::Mul(load(loops.ki_speed, lane), slip)));
      if (in.enabled != nullptr) grown = hn::Mul(grown, hn::Set(d, in.enabled[row]));
      V const before = load(loop.integral, lane);
      V const whole = hn::Add(asked, hn::Add(before, grown));
      V const beyond = hn::Sub(whole, clamped(whole, least, most));
      M const pushes = hn::Gt(hn::Mul(beyond, grown), hn::Zero(d));
      V const integral = hn::IfThenElse(pushes, before, hn::Add(before, grown));
      store(integral, loop.integral, lane);
      asked = hn::Add(asked, integral);
    }
    if (loops.has_least_drive) asked = driven(loops, error, asked, lane);
    command = clamped(asked, least, most);
    store(command, loop.command, lane);
  }
  return pass_on(loops, in, row, command, loop, lane);
}

void answer_lanes(LaneLoops const& loops, TickInputs const& inputs, std::size_t row, double const* read,
                  double const* speed, LaneLoopState& loop, double* held, double* logged) {
  for (std::size_t lane = 0; lane < replicate_lanes; lane += vector_lanes) {
    V const acting = answer(loops, inputs, row, hn::LoadU(d, read + lane), hn::LoadU(d, speed + lane), loop, lane);
    hn::StoreU(acting, d, held + lane);
    hn::StoreU(load(loop.logged, lane), d, logged + lane);
  }
  loop.clock.advance(loops);
}

void pass_on_lanes(LaneLoops const& loops, TickInputs const& inputs, std::size_t row, double const* command,
                   LaneLoopState& loop, double* held, double* logged) {
  for (std::size_t lane = 0; lane < replicate_lanes; lane += vector_lanes) {
    V const acting = pass_on(loops, inputs, row, hn::LoadU(d, command + lane), loop, lane);
    hn::StoreU(acting, d, held + lane);
    hn::StoreU(load(loop.logged, lane), d, logged + lane);
  }
  loop.clock.advance(loops);
}

// sine and cosine of an angle that turns a little from tick to tick
struct Turning {
  V sine, cosine;

  HWY_INLINE void turn(V way) {
    V const one = hn::Set(d, 1.0), square = hn::Mul(way, way);
    V const s = hn::Mul(
        way, hn::Sub(one, hn::Mul(square, hn::Sub(hn::Set(d, 1.0 / 6.0), hn::Mul(square, hn::Set(d, 1.0 / 120.0))))));
    V const c = hn::Sub(one, hn::Mul(square, hn::Sub(hn::Set(d, 0.5), hn::Mul(square, hn::Set(d, 1.0 / 24.0)))));
    V const turned_sine = hn::Add(hn::Mul(sine, c), hn::Mul(cosine, s));
    cosine = hn::Sub(hn::Mul(cosine, c), hn::Mul(sine, s));
    sine = turned_sine;
  }
};

template <bool has_weight>
void roll(RolledJoints const& rolled, LaneLoops const& loops, TickInputs const& in, std::size_t ticks,
          std::size_t steps, double const* sines, double const* cosines, LaneState& joint, LaneLoopState& loop,
          TickOutputs const& out) {
  V const step = hn::Set(d, loops.tick_s / static_cast<double>(steps)), one = hn::Set(d, 1.0);
  LoopClock const first_clock = loop.clock;
  LaneJoints const& joints = rolled.joints;
  for (std::size_t first = 0; first < replicate_lanes; first += n_vectors * vector_lanes) {
    V q[n_vectors], dq[n_vectors], ddq[n_vectors], per_inertia[n_vectors];
    Turning angle[n_vectors];
    for (std::size_t i = 0; i < n_vectors; ++i) {
      std::size_t const lane = first + i * vector_lanes;
      q[i] = load(joint.q, lane);
      dq[i] = load(joint.dq, lane);
      ddq[i] = load(joint.ddq, lane);
      per_inertia[i] = hn::Div(one, load(joints.inertia, lane));
      if constexpr (has_weight) angle[i] = {load(sines, lane), load(cosines, lane)};
    }
    loop.clock = first_clock;
    for (std::size_t tick = 0; tick < ticks; ++tick) {
      for (std::size_t i = 0; i < n_vectors; ++i) {
        std::size_t const lane = first + i * vector_lanes, at = tick * replicate_lanes + lane;
        V const read = loops.has_encoder ? read_by_steps(loops, q[i], lane) : q[i];
        hn::StoreU(read, d, out.position + at);
        if (out.velocity != nullptr) hn::StoreU(dq[i], d, out.velocity + at);
        V const motor = answer(loops, in, tick, read, dq[i], loop, lane);
        hn::StoreU(load(loop.logged, lane), d, out.torque + at);
        V held = hn::Sub(motor, load(rolled.offset, lane));
        if (in.outside != nullptr) held = hn::Add(held, hn::Set(d, in.outside[tick]));
        V braking = load(loops.back_emf, lane);
        if (in.enabled != nullptr) braking = hn::Mul(braking, hn::Set(d, in.enabled[tick]));
        V weight = hn::Zero(d), slope = hn::Zero(d);
        if constexpr (has_weight) {
          V const by_sine = load(joints.gravity_sin, lane), by_cosine = load(joints.gravity_cos, lane);
          weight =
              hn::Mul(per_inertia[i], hn::Add(hn::Mul(by_sine, angle[i].sine), hn::Mul(by_cosine, angle[i].cosine)));
          slope =
              hn::Mul(per_inertia[i], hn::Sub(hn::Mul(by_sine, angle[i].cosine), hn::Mul(by_cosine, angle[i].sine)));
        }
        V forward = load(rolled.dry.forward, lane), backward = load(rolled.dry.backward, lane);
        if (rolled.gears.any) {
          V const motor_torque = hn::Sub(motor, hn::Mul(braking, dq[i]));
          V const weight_torque = hn::Mul(weight, load(joints.inertia, lane));
          V sine = hn::Zero(d), cosine = hn::Zero(d);
          if constexpr (has_weight) sine = angle[i].sine, cosine = angle[i].cosine;
          V const more = friction_of_gear(rolled.gears, motor_torque, weight_torque, dq[i], sine, cosine, lane);
          // what lowers friction leaves none at the least
          forward = hn::Max(hn::Add(forward, more), hn::Zero(d));
          backward = hn::Min(hn::Sub(backward, more), hn::Zero(d));
        }
        Field<has_weight> const field(
            hn::Mul(hn::Sub(held, forward), per_inertia[i]), hn::Mul(hn::Sub(held, backward), per_inertia[i]),
            hn::Mul(hn::Add(load(joints.viscous, lane), braking), per_inertia[i]), q[i], weight, slope);
        V const from = q[i];
        for (std::size_t k = 0; k < steps; ++k) slide_step(field, step, q[i], dq[i], ddq[i]);
        if constexpr (has_weight) angle[i].turn(hn::Sub(q[i], from));
      }
      loop.clock.advance(loops);
    }
    for (std::size_t i = 0; i < n_vectors; ++i) {
      std::size_t const lane = first + i * vector_lanes;
      store(q[i], joint.q, lane);
      store(dq[i], joint.dq, lane);
      store(ddq[i], joint.ddq, lane);
    }
  }
}

void roll_light(RolledJoints const& rolled, LaneLoops const& loops, TickInputs const& in, std::size_t ticks,
                std::size_t steps, LaneState& joint, LaneLoopState& loop, TickOutputs const& out) {
  roll<false>(rolled, loops, in, ticks, steps, nullptr, nullptr, joint, loop, out);
}
void roll_heavy(RolledJoints const& rolled, LaneLoops const& loops, TickInputs const& in, std::size_t ticks,
                std::size_t steps, double const* sine, double const* cosine, LaneState& joint, LaneLoopState& loop,
                TickOutputs const& out) {
  roll<true>(rolled, loops, in, ticks, steps, sine, cosine, joint, loop, out);
}

}  // namespace torquescope::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace torquescope {
namespace {
TORQUESCOPE_EXPORT(roll_light);
TORQUESCOPE_EXPORT(roll_heavy);
TORQUESCOPE_EXPORT(answer_lanes);
TORQUESCOPE_EXPORT(pass_on_lanes);
TORQUESCOPE_EXPORT(gear_friction_lanes);
}  // namespace

void gear_friction(LaneGears const& gears, double const* motor, double const* weight, double const* speed,
                   double const* sine, double const* cosine, double* friction) {
  TORQUESCOPE_DISPATCH(gear_friction_lanes)(gears, motor, weight, speed, sine, cosine, friction);
}

void roll_ticks(RolledJoints const& rolled, LaneLoops const& loops, TickInputs const& inputs, std::size_t ticks,
                std::size_t steps, LaneState& joint, LaneLoopState& loop, TickOutputs const& outputs) {
  if (!rolled.needs_angle())
    return TORQUESCOPE_DISPATCH(roll_light)(rolled, loops, inputs, ticks, steps, joint, loop, outputs);
  alignas(64) double sine[replicate_lanes], cosine[replicate_lanes];
  kernels::cosine_sine_of_multiple(1.0, joint.q, replicate_lanes, cosine, sine);
  TORQUESCOPE_DISPATCH(roll_heavy)(rolled, loops, inputs, ticks, steps, sine, cosine, joint, loop, outputs);
}

void answer_tick(LaneLoops const& loops, TickInputs const& inputs, std::size_t row, double const* read,
                 double const* speed, LaneLoopState& loop, double* held, double* logged) {
  TORQUESCOPE_DISPATCH(answer_lanes)(loops, inputs, row, read, speed, loop, held, logged);
}

void pass_on_tick(LaneLoops const& loops, TickInputs const& inputs, std::size_t row, double const* command,
                  LaneLoopState& loop, double* held, double* logged) {
  TORQUESCOPE_DISPATCH(pass_on_lanes)(loops, inputs, row, command, loop, held, logged);
}

}  // namespace torquescope
#endif  // HWY_ONCE
