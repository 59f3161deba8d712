#include "engine/simulate/sticking_lanes.hpp"

#include "kernels/dispatch-inl.hpp"
#include "kernels/elementary.hpp"

// the part up to HWY_ONCE is compiled once per instruction set
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "engine/simulate/sticking_lanes.cpp"
#include "hwy/foreach_target.h"
#include "hwy/highway.h"

#include "engine/simulate/lane_field-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace torquescope::HWY_NAMESPACE {

// Dry friction as an acceleration, and the bend at the end of a step.
//
// The velocity at the end is `free` - slowed s, free: without half, slowed: what half takes in a step. Put into
// D (s - s_before) = step (velocity - v s) it is straight in s; where s would leave [-1, 1] its bound is the solution,
// for all terms grow with s
struct Bristle {
  V middle, half, length, step, per_total;

  HWY_INLINE Bristle(V held_forward, V held_backward, V damping, V creep, V own_length, V step_s)
      : middle(hn::Mul(hn::Set(d, 0.5), hn::Add(held_forward, held_backward))),
        half(hn::Mul(hn::Set(d, 0.5), hn::Sub(held_backward, held_forward))),
        length(own_length),
        step(step_s) {
    V const one = hn::Set(d, 1.0), half_step = hn::Mul(step, hn::Set(d, 0.5));
    V const slowed = hn::Mul(hn::Mul(step, half), hn::Sub(one, hn::Mul(half_step, damping)));
    V const total = hn::Add(length, hn::Mul(step, hn::Add(creep, slowed)));
    // neither friction nor sticking: s does not matter
    per_total = hn::Div(one, hn::IfThenElse(hn::Gt(total, hn::Zero(d)), total, one));
  }

  HWY_INLINE V bend_after(V bend, V free) const {
    V const one = hn::Set(d, 1.0);
    V const wanted = hn::Mul(hn::Add(hn::Mul(length, bend), hn::Mul(step, free)), per_total);
    return hn::Max(hn::Neg(one), hn::Min(one, wanted));
  }
};

template <bool has_weight>
void advance_bristles(LaneAccelerations const& accelerations, double step_s, std::size_t steps, LaneSticking& sticking,
                      LaneState& state) {
  V const step = hn::Set(d, step_s), one = hn::Set(d, 1.0);
  for (std::size_t lane = 0; lane < replicate_lanes; lane += vector_lanes) {
    Field<has_weight> const field(accelerations, lane);
    Bristle const bristle(field.held_forward, field.held_backward, field.damping, hn::Load(d, sticking.creep + lane),
                          hn::Load(d, sticking.length + lane), step);
    V q = hn::Load(d, state.q + lane), dq = hn::Load(d, state.dq + lane), ddq = hn::Zero(d);
    V bend = hn::Load(d, sticking.bend + lane);
    for (std::size_t k = 0; k < steps; ++k) {
      V const smooth = hn::Add(weight_of(field, q), hn::Mul(field.damping, dq));
      Slide<has_weight> const free(field, q, dq, hn::Sub(bristle.middle, smooth), step);
      bend = bristle.bend_after(bend, free.dq);
      // sliding: the very torque of the branch
      V const bent = hn::Sub(bristle.middle, hn::Mul(bristle.half, bend));
      V const held = hn::IfThenElse(hn::Eq(bend, one), field.held_forward,
                                    hn::IfThenElse(hn::Eq(bend, hn::Neg(one)), field.held_backward, bent));
      ddq = hn::Sub(held, smooth);
      Slide<has_weight> const next(field, q, dq, ddq, step);
      q = next.q;
      dq = next.dq;
    }
    hn::Store(q, d, state.q + lane);
    hn::Store(dq, d, state.dq + lane);
    hn::Store(ddq, d, state.ddq + lane);
    hn::Store(bend, d, sticking.bend + lane);
  }
}

void advance_sticking_light(LaneJoints const& joints, LaneTorques const& torques, double step_s, std::size_t steps,
                            LaneSticking& sticking, LaneState& state) {
  LaneAccelerations a;
  accelerate<false>(joints, torques, state, nullptr, nullptr, a);
  advance_bristles<false>(a, step_s, steps, sticking, state);
}
void advance_sticking_heavy(LaneJoints const& joints, LaneTorques const& torques, double const* sine,
                            double const* cosine, double step_s, std::size_t steps, LaneSticking& sticking,
                            LaneState& state) {
  LaneAccelerations a;
  accelerate<true>(joints, torques, state, sine, cosine, a);
  advance_bristles<true>(a, step_s, steps, sticking, state);
}

}  // namespace torquescope::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace torquescope {
namespace {
TORQUESCOPE_EXPORT(advance_sticking_light);
TORQUESCOPE_EXPORT(advance_sticking_heavy);
}  // namespace

void advance_sticking_lanes(LaneJoints const& joints, LaneTorques const& torques, double step_s, std::size_t steps,
                            LaneSticking& sticking, LaneState& state) {
  if (!joints.has_weight)
    return TORQUESCOPE_DISPATCH(advance_sticking_light)(joints, torques, step_s, steps, sticking, state);
  alignas(64) double sine[replicate_lanes], cosine[replicate_lanes];
  kernels::cosine_sine_of_multiple(1.0, state.q, replicate_lanes, cosine, sine);
  TORQUESCOPE_DISPATCH(advance_sticking_heavy)(joints, torques, sine, cosine, step_s, steps, sticking, state);
}

}  // namespace torquescope
#endif  // HWY_ONCE
