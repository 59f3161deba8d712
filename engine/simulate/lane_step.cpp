#include "engine/simulate/lane_step.hpp"

#include <algorithm>
#include <cstddef>

#include "kernels/dispatch-inl.hpp"

// the part up to HWY_ONCE is compiled once per instruction set
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "engine/simulate/lane_step.cpp"
#include "hwy/foreach_target.h"
#include "hwy/highway.h"

#include "engine/simulate/lane_field-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace torquescope::HWY_NAMESPACE {

namespace {

// An effect may take nearly all of the joint's inertia and answer by a spring (a load on a light motor). What it takes
// beyond this share that stays goes by the acceleration of the step before.
inline constexpr double least_inertia_left = 0.05;

}  // namespace

void foresee(LaneState const& state, LaneInstant& at) {
  V const half = hn::Set(d, 0.5 * at.step_s), zero = hn::Zero(d);
  for (std::size_t lane = 0; lane < replicate_lanes; lane += hn::MaxLanes(d)) {
    V const dq = hn::LoadU(d, state.dq + lane), ddq = hn::LoadU(d, state.ddq + lane);
    V const next = hn::Add(dq, hn::Mul(half, ddq));
    hn::StoreU(hn::Add(hn::LoadU(d, state.q + lane), hn::Mul(half, dq)), d, at.q + lane);
    hn::StoreU(hn::IfThenElseZero(hn::Gt(hn::Mul(next, dq), zero), next), d, at.dq + lane);
    hn::StoreU(ddq, d, at.ddq + lane);
  }
}

void load(double const* inertia, LaneDryFriction const& friction, double const* held, double const* level,
          LaneDemand const& demand, LaneState const& state, LaneTorques& torques) {
  V const taken = hn::Set(d, 1.0 - least_inertia_left), zero = hn::Zero(d), half = hn::Set(d, 0.5);
  for (std::size_t lane = 0; lane < replicate_lanes; lane += hn::MaxLanes(d)) {
    V const most_taken = hn::Neg(hn::Mul(taken, hn::LoadU(d, inertia + lane)));
    V const to_forward = hn::LoadU(d, friction.forward + lane), to_backward = hn::LoadU(d, friction.backward + lane);
    V const wanted = hn::LoadU(d, demand.inertia + lane), own = hn::LoadU(d, level + lane);
    V const added = hn::IfThenElse(hn::Lt(wanted, most_taken), most_taken, wanted);
    V const lagging = hn::Mul(hn::Sub(wanted, added), hn::LoadU(d, state.ddq + lane));
    V const acts = hn::Sub(hn::LoadU(d, held + lane), hn::LoadU(d, demand.smooth + lane));
    V const forward = hn::Add(hn::Mul(own, to_forward), hn::LoadU(d, demand.forward + lane));
    V const backward = hn::Add(hn::Mul(own, to_backward), hn::LoadU(d, demand.backward + lane));
    // friction that an effect turned into a drive holds nothing at rest; what slides keeps the torque of its own branch
    V const dq = hn::LoadU(d, state.dq + lane);
    V const at_rest = hn::Mul(half, hn::Add(forward, backward));
    V const branch = hn::IfThenElse(hn::Gt(dq, zero), forward, hn::IfThenElse(hn::Lt(dq, zero), backward, at_rest));
    auto const drives = hn::Lt(forward, backward);
    hn::StoreU(added, d, torques.added_inertia + lane);
    hn::StoreU(hn::Sub(acts, lagging), d, torques.held + lane);
    hn::StoreU(hn::IfThenElse(drives, branch, forward), d, torques.forward + lane);
    hn::StoreU(hn::IfThenElse(drives, branch, backward), d, torques.backward + lane);
  }
}

void add(double const* torque, double* sum) {
  for (std::size_t lane = 0; lane < replicate_lanes; lane += hn::MaxLanes(d))
    hn::StoreU(hn::Add(hn::LoadU(d, sum + lane), hn::LoadU(d, torque + lane)), d, sum + lane);
}

void straight(double const* coasting, double const* at_one, LaneDemand& demand) {
  for (std::size_t lane = 0; lane < replicate_lanes; lane += hn::MaxLanes(d)) {
    V const smooth = hn::LoadU(d, coasting + lane), slope = hn::Sub(hn::LoadU(d, at_one + lane), smooth);
    hn::StoreU(hn::Add(hn::LoadU(d, demand.smooth + lane), smooth), d, demand.smooth + lane);
    hn::StoreU(hn::Add(hn::LoadU(d, demand.inertia + lane), slope), d, demand.inertia + lane);
  }
}

}  // namespace torquescope::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace torquescope {
namespace {
TORQUESCOPE_EXPORT(foresee);
TORQUESCOPE_EXPORT(load);
TORQUESCOPE_EXPORT(add);
TORQUESCOPE_EXPORT(straight);
}  // namespace

void foresee_lanes(LaneState const& state, LaneInstant& at) {
  TORQUESCOPE_DISPATCH(foresee)(state, at);
  at.time_s += 0.5 * at.step_s;
}

LaneDryFriction::LaneDryFriction(double forward_, double backward_) {
  std::fill_n(forward, replicate_lanes, forward_);
  std::fill_n(backward, replicate_lanes, backward_);
}

void load_lanes(double const* inertia, LaneDryFriction const& friction, double const* held, double const* level,
                LaneDemand const& demand, LaneState const& state, LaneTorques& torques) {
  TORQUESCOPE_DISPATCH(load)(inertia, friction, held, level, demand, state, torques);
}

void add_lanes(double const* torque, double* sum) { TORQUESCOPE_DISPATCH(add)(torque, sum); }

void add_straight(double const* coasting, double const* at_one, LaneDemand& demand) {
  TORQUESCOPE_DISPATCH(straight)(coasting, at_one, demand);
}

}  // namespace torquescope
#endif  // HWY_ONCE
