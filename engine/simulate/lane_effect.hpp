#pragma once
// A torque beside the baseline joint, for all lanes of a group of twins at once: how an accepted effect enters the twin.
//
// Equation   the joint needs smooth + (forward while dq > 0, backward while dq < 0, anything between them at rest)
// Called     once per integration step, in the order of time: an effect with memory advances its own state by step_s
// Shapes     twin_lanes numbers each; add() adds to what is there
// Units      SI
// Threads    one object per group of twins, used by one thread; a LaneEffectMaker is called from any number of threads

#include <functional>
#include <memory>
#include <vector>

#include "engine/effects/effect.hpp"
#include "engine/simulate/twin_lanes.hpp"

namespace torquescope {

// the middle of the coming step, as far as it can be foreseen
struct LaneInstant {
  double time_s = 0.0, step_s = 0.0;
  alignas(64) double q[twin_lanes] = {};
  alignas(64) double dq[twin_lanes] = {};
  alignas(64) double ddq[twin_lanes] = {};
};

struct LaneDemand {
  alignas(64) double smooth[twin_lanes] = {};
  alignas(64) double forward[twin_lanes] = {};
  alignas(64) double backward[twin_lanes] = {};
};

class LaneEffect {
 public:
  virtual ~LaneEffect() = default;
  virtual void add(LaneInstant const& at, LaneDemand& demand) = 0;
};

// a fresh object, its memory at the start of a recording
using LaneEffectMaker = std::function<std::unique_ptr<LaneEffect>()>;

// an effect without memory, lane by lane; parameters as Effect::torque takes them
LaneEffectMaker lane_effect(Effect const& effect, std::vector<double> parameters);

}  // namespace torquescope
