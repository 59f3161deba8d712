// One step of a joint whose dry friction holds at once (replicate_lanes.hpp); compiled once per instruction set, so no
// #pragma once.
//
// Equation   that of lane_field-inl.hpp while it slides; where the velocity meets zero the step is cut, and the rest of
//            it begins with the question whether friction holds

#include "engine/simulate/lane_field-inl.hpp"

#if defined(TORQUESCOPE_SIMULATE_LANE_SLIDING_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef TORQUESCOPE_SIMULATE_LANE_SLIDING_INL
#undef TORQUESCOPE_SIMULATE_LANE_SLIDING_INL
#else
#define TORQUESCOPE_SIMULATE_LANE_SLIDING_INL
#endif

HWY_BEFORE_NAMESPACE();
namespace torquescope::HWY_NAMESPACE {

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
HWY_INLINE void slide_step(Field<has_weight> const& field, V step, V& q, V& dq, V& ddq) {
  V const weight = weight_of(field, q);
  Moving const moving = direction(weight, dq, field.held_forward, field.held_backward);
  ddq = acceleration(field, weight, dq, moving);
  Slide<has_weight> next(field, q, dq, ddq, step);
  M const cut = turned(moving, next.dq);
  // reversals are rare, and replicates reverse together
  if (HWY_UNLIKELY(!hn::AllFalse(d, cut))) cut_step(field, cut, q, dq, ddq, step, next.q, next.dq);
  q = next.q;
  dq = next.dq;
}

}  // namespace torquescope::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
