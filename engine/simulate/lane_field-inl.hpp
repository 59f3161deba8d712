// Smooth motion within a step, for every model of dry friction; compiled once per instruction set, so no #pragma once.
//
// Equation   ddq = held - weight(q) - damping dq, each over the inertia; weight: its Taylor series about an angle
// Steps      second-order Taylor

#include "engine/simulate/replicate_lanes.hpp"
#include "hwy/highway.h"

#ifndef TORQUESCOPE_SIMULATE_LANE_ACCELERATIONS
#define TORQUESCOPE_SIMULATE_LANE_ACCELERATIONS
namespace torquescope {
// accelerations: every torque divided by the inertia; the weight as its Taylor series about `from`
struct LaneAccelerations {
  alignas(64) double held_forward[replicate_lanes];
  alignas(64) double held_backward[replicate_lanes];
  alignas(64) double from[replicate_lanes];
  alignas(64) double weight[replicate_lanes];
  alignas(64) double weight_slope[replicate_lanes];
  alignas(64) double damping[replicate_lanes];
};
}  // namespace torquescope
#endif

#if defined(TORQUESCOPE_SIMULATE_LANE_FIELD_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef TORQUESCOPE_SIMULATE_LANE_FIELD_INL
#undef TORQUESCOPE_SIMULATE_LANE_FIELD_INL
#else
#define TORQUESCOPE_SIMULATE_LANE_FIELD_INL
#endif

HWY_BEFORE_NAMESPACE();
namespace torquescope::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using D = hn::CappedTag<double, replicate_lanes>;
using V = hn::Vec<D>;
using M = hn::Mask<D>;
inline constexpr D d;
inline constexpr std::size_t vector_lanes = hn::MaxLanes(d);
// two vectors in flight hide half of each other's latency; more would spill with AVX2's 16 registers
inline constexpr std::size_t n_vectors = vector_lanes * 2 <= replicate_lanes ? 2 : 1;

// sine, cosine: of the angle, where there is a weight
template <bool has_weight>
HWY_INLINE void accelerate(LaneJoints const& joints, LaneTorques const& torques, LaneState const& state,
                           double const* sine, double const* cosine, LaneAccelerations& a) {
  V const one = hn::Set(d, 1.0);
  for (std::size_t lane = 0; lane < replicate_lanes; lane += vector_lanes) {
    V const inertia = hn::Load(d, joints.inertia + lane);
    V const per_inertia = hn::Div(one, hn::Add(inertia, hn::Load(d, torques.added_inertia + lane)));
    V const held = hn::Load(d, torques.held + lane);
    hn::Store(hn::Mul(hn::Load(d, joints.viscous + lane), per_inertia), d, a.damping + lane);
    hn::Store(hn::Mul(hn::Sub(held, hn::Load(d, torques.forward + lane)), per_inertia), d, a.held_forward + lane);
    hn::Store(hn::Mul(hn::Sub(held, hn::Load(d, torques.backward + lane)), per_inertia), d, a.held_backward + lane);
    hn::Store(hn::Load(d, state.q + lane), d, a.from + lane);
    if constexpr (has_weight) {
      V const s = hn::Load(d, sine + lane), c = hn::Load(d, cosine + lane);
      V const gravity_sin = hn::Load(d, joints.gravity_sin + lane),
              gravity_cos = hn::Load(d, joints.gravity_cos + lane);
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

  // accelerations: of what holds in either direction, and of the weight at `from_` with its slope there
  HWY_INLINE Field(V forward, V backward, V damping_, V from_, V weight_, V slope)
      : held_forward(forward),
        held_backward(backward),
        damping(damping_),
        from(from_),
        weight(weight_),
        weight_slope(slope),
        weight_half(hn::Mul(weight_, hn::Set(d, 0.5))),
        slope_sixth(hn::Mul(slope, hn::Set(d, 1.0 / 6.0))) {}

  // w0 + w1 x - w0 x^2/2 - w1 x^3/6
  HWY_INLINE V weight_at(V q) const {
    V const x = hn::Sub(q, from);
    V const inner = hn::Sub(weight_slope, hn::Mul(x, hn::Add(weight_half, hn::Mul(x, slope_sixth))));
    return hn::Add(weight, hn::Mul(x, inner));
  }
  HWY_INLINE V slope_at(V q) const { return hn::Sub(weight_slope, hn::Mul(hn::Sub(q, from), weight)); }
};

template <bool has_weight>
HWY_INLINE V weight_of(Field<has_weight> const& field, V q) {
  if constexpr (has_weight)
    return field.weight_at(q);
  else
    return hn::Zero(d);
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

}  // namespace torquescope::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
