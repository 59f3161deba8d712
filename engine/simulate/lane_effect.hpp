#pragma once
// A torque beside the baseline joint, for all lanes of a group of replicates: how an accepted effect is simulated.
//
// Joint      add(): the joint needs smooth + inertia ddq + (forward while dq > 0, backward while dq < 0, anything
//            between them at rest); called once per integration step or tick, in the order of time
// Channels   shift_position(): added before the encoder, so the controller sees it; shift_torque(): added to the logged
//            torque, which nobody else sees; called once per tick
// Shapes     replicate_lanes numbers each; every function adds to what is there
// Units      SI
// Threads    one object per group of replicates, used by one thread; a LaneEffectMaker is called from any number

#include <Eigen/Core>
#include <functional>
#include <memory>
#include <vector>

#include "engine/effects/effect.hpp"
#include "engine/simulate/replicate_lanes.hpp"

namespace torquescope {

// add(): the middle of the coming step, as far as it can be foreseen; channels: the tick itself, step_s a whole tick
struct LaneInstant {
  double time_s = 0.0, step_s = 0.0;
  alignas(64) double q[replicate_lanes] = {};
  alignas(64) double dq[replicate_lanes] = {};
  alignas(64) double ddq[replicate_lanes] = {};
  alignas(64) double motor_torque[replicate_lanes] = {};  // held since the last tick, without the gear load
};

struct LaneDemand {
  alignas(64) double smooth[replicate_lanes] = {};
  alignas(64) double inertia[replicate_lanes] = {};
  alignas(64) double forward[replicate_lanes] = {};
  alignas(64) double backward[replicate_lanes] = {};
};

class LaneEffect {
 public:
  virtual ~LaneEffect() = default;
  // true: add() is called at every integration step; false: once per tick, for its middle (second order in the tick,
  // and the torque is held between ticks anyway), unless the joint is faster than its ticks
  virtual bool follows_steps() const { return true; }
  virtual void add(LaneInstant const&, LaneDemand&) {}
  virtual bool shifts_channels() const { return false; }
  virtual void shift_position(LaneInstant const&, double*) {}
  virtual void shift_torque(LaneInstant const&, double*) {}
};

// what an effect is told of the joint it stands beside
struct LaneBaseline {
  LaneJoints joint{};
  // load that passes the gear beside inertia and weight, one per tick from time 0 on; none
  std::shared_ptr<Eigen::VectorXd const> gear_load{};
  double rate_hz = 0.0;                         // of it
  std::shared_ptr<GivenSignals const> given{};  // one per tick, of effects of several joints; none
};

// a fresh object, its memory at the start of a recording
using LaneEffectMaker = std::function<std::unique_ptr<LaneEffect>()>;

// an effect of the catalogue, lane by lane, each with its own memory, at the place where it acts (Effect::acts_on);
// parameters as Effect::runner takes them. baseline: what its load torque is made of, inertia and gravity
LaneEffectMaker lane_effect(Effect const& effect, std::vector<double> const& parameters, JointScales const& scales,
                            LaneBaseline const& baseline = {});
// the same with parameters of each lane, as the trials of a fit have: [replicate_lanes][parameters]. Bits of a lane are
// those that it has with these parameters in all lanes
LaneEffectMaker lane_effect_of_each(Effect const& effect, Eigen::ArrayXXd parameters, JointScales const& scales,
                                    LaneBaseline const& baseline = {});

}  // namespace torquescope
