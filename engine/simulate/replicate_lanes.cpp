#include "engine/simulate/replicate_lanes.hpp"

#include "kernels/dispatch-inl.hpp"
#include "kernels/elementary.hpp"

// the part up to HWY_ONCE is compiled once per instruction set
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "engine/simulate/replicate_lanes.cpp"
#include "hwy/foreach_target.h"
#include "hwy/highway.h"

#include "engine/simulate/lane_sliding-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace torquescope::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

template <bool has_weight>
void advance(LaneAccelerations const& accelerations, double step_s, std::size_t steps, LaneState& state) {
  V const step = hn::Set(d, step_s);
  for (std::size_t first = 0; first < replicate_lanes; first += n_vectors * vector_lanes) {
    V q[n_vectors], dq[n_vectors], ddq[n_vectors];
    for (std::size_t i = 0; i < n_vectors; ++i) {
      q[i] = hn::Load(d, state.q + first + i * vector_lanes);
      dq[i] = hn::Load(d, state.dq + first + i * vector_lanes);
      ddq[i] = hn::Zero(d);
    }
    for (std::size_t k = 0; k < steps; ++k) {
      for (std::size_t i = 0; i < n_vectors; ++i) {
        Field<has_weight> const field(accelerations, first + i * vector_lanes);
        slide_step(field, step, q[i], dq[i], ddq[i]);
      }
    }
    for (std::size_t i = 0; i < n_vectors; ++i) {
      hn::Store(q[i], d, state.q + first + i * vector_lanes);
      hn::Store(dq[i], d, state.dq + first + i * vector_lanes);
      hn::Store(ddq[i], d, state.ddq + first + i * vector_lanes);
    }
  }
}

void advance_light(LaneJoints const& joints, LaneTorques const& torques, double step_s, std::size_t steps,
                   LaneState& state) {
  LaneAccelerations a;
  accelerate<false>(joints, torques, state, nullptr, nullptr, a);
  advance<false>(a, step_s, steps, state);
}
void advance_heavy(LaneJoints const& joints, LaneTorques const& torques, double const* sine, double const* cosine,
                   double step_s, std::size_t steps, LaneState& state) {
  LaneAccelerations a;
  accelerate<true>(joints, torques, state, sine, cosine, a);
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

LaneJoints::LaneJoints(LaneJoint const& same) {
  for (std::size_t lane = 0; lane < replicate_lanes; ++lane) set(lane, same);
}

void LaneJoints::set(std::size_t lane, LaneJoint const& joint) {
  inertia[lane] = joint.inertia;
  viscous[lane] = joint.viscous;
  gravity_sin[lane] = joint.gravity_sin;
  gravity_cos[lane] = joint.gravity_cos;
  has_weight = has_weight || joint.gravity_sin != 0.0 || joint.gravity_cos != 0.0;
}

void advance_lanes(LaneJoints const& joints, LaneTorques const& torques, double step_s, std::size_t steps,
                   LaneState& state) {
  if (!joints.has_weight) return TORQUESCOPE_DISPATCH(advance_light)(joints, torques, step_s, steps, state);
  alignas(64) double sine[replicate_lanes], cosine[replicate_lanes];
  kernels::cosine_sine_of_multiple(1.0, state.q, replicate_lanes, cosine, sine);
  TORQUESCOPE_DISPATCH(advance_heavy)(joints, torques, sine, cosine, step_s, steps, state);
}

}  // namespace torquescope
#endif  // HWY_ONCE
