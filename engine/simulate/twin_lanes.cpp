#include "engine/simulate/twin_lanes.hpp"

#include "kernels/dispatch-inl.hpp"
#include "kernels/elementary.hpp"

// the part up to HWY_ONCE is compiled once per instruction set
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "engine/simulate/twin_lanes.cpp"
#include "hwy/foreach_target.h"
#include "hwy/highway.h"

#include "engine/simulate/lane_field-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace torquescope::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

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

HWY_INLINE M turned(Moving const& moving, V dq) {
  V const zero = hn::Zero(d);
  return hn::Or(hn::And(moving.forward, hn::Lt(dq, zero)), hn::And(moving.backward, hn::Gt(dq, zero)));
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
