#include "engine/simulate/twin_lanes.hpp"

#include "kernels/dispatch-inl.hpp"
#include "kernels/elementary.hpp"

// the part up to HWY_ONCE is compiled once per instruction set
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "engine/simulate/twin_lanes.cpp"
#include "hwy/foreach_target.h"
#include "hwy/highway.h"

#ifndef TORQUESCOPE_SIMULATE_TWIN_LANES
#define TORQUESCOPE_SIMULATE_TWIN_LANES
namespace torquescope {
// accelerations: every torque divided by the inertia; the weight as its Taylor series about `from`
struct LaneAccelerations {
  alignas(64) double held_forward[twin_lanes];
  alignas(64) double held_backward[twin_lanes];
  alignas(64) double from[twin_lanes];
  alignas(64) double weight[twin_lanes];
  alignas(64) double weight_slope[twin_lanes];
  alignas(64) double damping[twin_lanes];
};
}  // namespace torquescope
#endif

HWY_BEFORE_NAMESPACE();
namespace torquescope::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using D = hn::CappedTag<double, twin_lanes>;
using V = hn::Vec<D>;
using M = hn::Mask<D>;
inline constexpr D d;
inline constexpr std::size_t vector_lanes = hn::MaxLanes(d);
// two vectors in flight hide half of each other's latency; more would spill with AVX2's 16 registers
inline constexpr std::size_t n_vectors = vector_lanes * 2 <= twin_lanes ? 2 : 1;

// sine, cosine: of the angle, where there is a weight
template <bool has_weight>
HWY_INLINE void accelerate(LaneJoint const& joint, LaneTorques const& torques, LaneState const& state,
                           double const* sine, double const* cosine, LaneAccelerations& a) {
  V const one = hn::Set(d, 1.0), inertia = hn::Set(d, joint.inertia), viscous = hn::Set(d, joint.viscous);
  V const gravity_sin = hn::Set(d, joint.gravity_sin), gravity_cos = hn::Set(d, joint.gravity_cos);
  for (std::size_t lane = 0; lane < twin_lanes; lane += vector_lanes) {
    V const per_inertia = hn::Div(one, hn::Add(inertia, hn::Load(d, torques.added_inertia + lane)));
    V const held = hn::Load(d, torques.held + lane);
    hn::Store(hn::Mul(viscous, per_inertia), d, a.damping + lane);
    hn::Store(hn::Mul(hn::Sub(held, hn::Load(d, torques.forward + lane)), per_inertia), d, a.held_forward + lane);
    hn::Store(hn::Mul(hn::Sub(held, hn::Load(d, torques.backward + lane)), per_inertia), d, a.held_backward + lane);
    hn::Store(hn::Load(d, state.q + lane), d, a.from + lane);
    if constexpr (has_weight) {
      V const s = hn::Load(d, sine + lane), c = hn::Load(d, cosine + lane);
      V const weight = hn::Add(hn::Mul(gravity_sin, s), hn::Mul(gravity_cos, c));
      V const slope = hn::Sub(hn::Mul(gravity_sin, c), hn::Mul(gravity_cos, s));
      hn::Store(hn::Mul(weight, per_inertia), d, a.weight + lane);
      hn::Store(hn::Mul(slope, per_inertia), d, a.weight_slope + lane);
    } else {
      hn::Store(hn::Zero(d), d, a.weight + lane);
      hn::Store(hn::Zero(d), d, a.weight_slope + lane);
    }
  }
}

template <bool has_weight>
struct Field {
  V held_forward, held_backward, damping;
  V from, weight, weight_slope, weight_half, slope_sixth;

  HWY_INLINE Field(LaneAccelerations const& a, std::size_t lane)
      : held_forward(hn::Load(d, a.held_forward + lane)),
        held_backward(hn::Load(d, a.held_backward + lane)),
        damping(hn::Load(d, a.damping + lane)),
        from(hn::Load(d, a.from + lane)),
        weight(hn::Load(d, a.weight + lane)),
        weight_slope(hn::Load(d, a.weight_slope + lane)),
        weight_half(hn::Mul(weight, hn::Set(d, 0.5))),
        slope_sixth(hn::Mul(weight_slope, hn::Set(d, 1.0 / 6.0))) {}

  // w0 + w1 x - w0 x^2/2 - w1 x^3/6
  HWY_INLINE V weight_at(V q) const {
    V const x = hn::Sub(q, from);
    V const inner = hn::Sub(weight_slope, hn::Mul(x, hn::Add(weight_half, hn::Mul(x, slope_sixth))));
    return hn::Add(weight, hn::Mul(x, inner));
  }
  HWY_INLINE V slope_at(V q) const { return hn::Sub(weight_slope, hn::Mul(hn::Sub(q, from), weight)); }
};

struct Moving {
  M forward, backward;
};

// where to at this instant: along the velocity, or from rest whereto the torque is stronger than friction
HWY_INLINE Moving direction(V q_weight, V dq, V held_forward, V held_backward) {
  V const zero = hn::Zero(d);
  M const rest = hn::Eq(dq, zero);
  M const forward = hn::Or(hn::Gt(dq, zero), hn::And(rest, hn::Gt(held_forward, q_weight)));
  M const backward = hn::Or(hn::Lt(dq, zero), hn::And(rest, hn::Lt(held_backward, q_weight)));
  return {forward, backward};
}

// acceleration while sliding in this direction; 0 where held
template <bool has_weight>
HWY_INLINE V acceleration(Field<has_weight> const& field, V weight, V dq, Moving const& moving) {
  V const held = hn::IfThenElse(moving.forward, field.held_forward, field.held_backward);
  V const a = hn::Sub(hn::Sub(held, weight), hn::Mul(field.damping, dq));
  return hn::IfThenElseZero(hn::Or(moving.forward, moving.backward), a);
}

template <bool has_weight>
struct Slide {
  V q, dq;
  HWY_INLINE Slide(Field<has_weight> const& field, V q0, V dq0, V a, V step) {
    V const half = hn::Mul(step, hn::Set(d, 0.5));
    V jerk = hn::Mul(field.damping, a);
    if constexpr (has_weight) jerk = hn::Add(jerk, hn::Mul(field.slope_at(q0), dq0));
    dq = hn::Add(dq0, hn::Mul(step, hn::Sub(a, hn::Mul(half, jerk))));
    q = hn::Add(q0, hn::Mul(step, hn::Add(dq0, hn::Mul(half, a))));
  }
};

HWY_INLINE M turned(Moving const& moving, V dq) {
  V const zero = hn::Zero(d);
  return hn::Or(hn::And(moving.forward, hn::Lt(dq, zero)), hn::And(moving.backward, hn::Gt(dq, zero)));
}

template <bool has_weight>
HWY_INLINE V weight_of(Field<has_weight> const& field, V q) {
  if constexpr (has_weight)
    return field.weight_at(q);
  else
    return hn::Zero(d);
}

// lanes whose velocity met zero: slide to there, then ask friction again for the rest of the step
template <bool has_weight>
HWY_INLINE void cut_step(Field<has_weight> const& field, M cut, V q0, V dq0, V a, V step, V& q, V& dq) {
  // a lane that started at rest and came back is one that friction would have held: sliding time 0
  V const drop = hn::Sub(dq0, dq);
  V const sliding = hn::IfThenElseZero(cut, hn::Mul(step, hn::Div(dq0, hn::IfThenElse(cut, drop, hn::Set(d, 1.0)))));
  V const q_stop = Slide<has_weight>(field, q0, dq0, a, sliding).q;
  V const left = hn::Sub(step, sliding);
  V const weight = weight_of(field, q_stop);
  V const rest = hn::Zero(d);
  Moving const moving = direction(weight, rest, field.held_forward, field.held_backward);
  V const again = acceleration(field, weight, rest, moving);
  Slide<has_weight> const second(field, q_stop, rest, again, left);
  // a lane that began the step at rest, or would turn twice, is held
  M const held = hn::Or(turned(moving, second.dq), hn::Eq(dq0, rest));
  q = hn::IfThenElse(cut, hn::IfThenElse(held, q_stop, second.q), q);
  dq = hn::IfThenElse(cut, hn::IfThenElse(held, rest, second.dq), dq);
}

template <bool has_weight>
void advance(LaneAccelerations const& accelerations, double step_s, std::size_t steps, LaneState& state) {
  V const step = hn::Set(d, step_s);
  for (std::size_t first = 0; first < twin_lanes; first += n_vectors * vector_lanes) {
    V q[n_vectors], dq[n_vectors], ddq[n_vectors];
    for (std::size_t i = 0; i < n_vectors; ++i) {
      q[i] = hn::Load(d, state.q + first + i * vector_lanes);
      dq[i] = hn::Load(d, state.dq + first + i * vector_lanes);
      ddq[i] = hn::Zero(d);
    }
    for (std::size_t k = 0; k < steps; ++k) {
      for (std::size_t i = 0; i < n_vectors; ++i) {
        Field<has_weight> const field(accelerations, first + i * vector_lanes);
        V const weight = weight_of(field, q[i]);
        Moving const moving = direction(weight, dq[i], field.held_forward, field.held_backward);
        ddq[i] = acceleration(field, weight, dq[i], moving);
        Slide<has_weight> next(field, q[i], dq[i], ddq[i], step);
        M const cut = turned(moving, next.dq);
        // reversals are rare, and twins reverse together
        if (HWY_UNLIKELY(!hn::AllFalse(d, cut))) cut_step(field, cut, q[i], dq[i], ddq[i], step, next.q, next.dq);
        q[i] = next.q;
        dq[i] = next.dq;
      }
    }
    for (std::size_t i = 0; i < n_vectors; ++i) {
      hn::Store(q[i], d, state.q + first + i * vector_lanes);
      hn::Store(dq[i], d, state.dq + first + i * vector_lanes);
      hn::Store(ddq[i], d, state.ddq + first + i * vector_lanes);
    }
  }
}

void advance_light(LaneJoint const& joint, LaneTorques const& torques, double step_s, std::size_t steps,
                   LaneState& state) {
  LaneAccelerations a;
  accelerate<false>(joint, torques, state, nullptr, nullptr, a);
  advance<false>(a, step_s, steps, state);
}
void advance_heavy(LaneJoint const& joint, LaneTorques const& torques, double const* sine, double const* cosine,
                   double step_s, std::size_t steps, LaneState& state) {
  LaneAccelerations a;
  accelerate<true>(joint, torques, state, sine, cosine, a);
  advance<true>(a, step_s, steps, state);
}

}  // namespace torquescope::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace torquescope {
namespace {
TORQUESCOPE_EXPORT(advance_light);
TORQUESCOPE_EXPORT(advance_heavy);
}  // namespace

void advance_lanes(LaneJoint const& joint, LaneTorques const& torques, double step_s, std::size_t steps,
                   LaneState& state) {
  if (joint.gravity_sin == 0.0 && joint.gravity_cos == 0.0)
    return TORQUESCOPE_DISPATCH(advance_light)(joint, torques, step_s, steps, state);
  alignas(64) double sine[twin_lanes], cosine[twin_lanes];
  kernels::cosine_sine_of_multiple(1.0, state.q, twin_lanes, cosine, sine);
  TORQUESCOPE_DISPATCH(advance_heavy)(joint, torques, sine, cosine, step_s, steps, state);
}

}  // namespace torquescope
#endif  // HWY_ONCE
