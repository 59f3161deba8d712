#include "engine/simulate/trial_effect.hpp"

#include <utility>

#include "engine/base/contract.hpp"

namespace torquescope {
namespace {

// lanes of one set of parameters
struct Group {
  std::vector<std::size_t> lanes{};
  std::vector<double> parameters{};
  LaneEffectMaker make{};
};

LaneInstant gathered(LaneInstant const& at, std::vector<std::size_t> const& lanes) {
  LaneInstant few;
  few.time_s = at.time_s;
  few.step_s = at.step_s;
  for (std::size_t i = 0; i < lanes.size(); ++i) {
    few.q[i] = at.q[lanes[i]];
    few.dq[i] = at.dq[lanes[i]];
    few.ddq[i] = at.ddq[lanes[i]];
    few.motor_torque[i] = at.motor_torque[lanes[i]];
  }
  return few;
}

LaneBaseline gathered(LaneBaseline baseline, std::vector<std::size_t> const& lanes) {
  LaneJoints const all = baseline.joint;
  baseline.joint = {};
  for (std::size_t i = 0; i < lanes.size(); ++i)
    baseline.joint.set(
        i, {all.inertia[lanes[i]], all.viscous[lanes[i]], all.gravity_sin[lanes[i]], all.gravity_cos[lanes[i]]});
  return baseline;
}

class EffectOfTrials final : public LaneEffect {
 public:
  explicit EffectOfTrials(std::vector<Group> const& groups) {
    for (auto const& group : groups) groups_.push_back({group.lanes, group.make()});
  }

  bool follows_steps() const override { return groups_.front().effect->follows_steps(); }

  bool shifts_channels() const override { return groups_.front().effect->shifts_channels(); }

  void add(LaneInstant const& at, LaneDemand& demand) override {
    for (auto const& [lanes, effect] : groups_) {
      LaneDemand few;
      effect->add(gathered(at, lanes), few);
      for (std::size_t i = 0; i < lanes.size(); ++i) {
        demand.smooth[lanes[i]] += few.smooth[i];
        demand.inertia[lanes[i]] += few.inertia[i];
        demand.forward[lanes[i]] += few.forward[i];
        demand.backward[lanes[i]] += few.backward[i];
      }
    }
  }

  void shift_position(LaneInstant const& at, double* position) override {
    for (auto const& [lanes, effect] : groups_) {
      double few[replicate_lanes] = {};
      effect->shift_position(gathered(at, lanes), few);
      for (std::size_t i = 0; i < lanes.size(); ++i) position[lanes[i]] += few[i];
    }
  }

  void shift_torque(LaneInstant const& at, double* torque) override {
    for (auto const& [lanes, effect] : groups_) {
      double few[replicate_lanes] = {};
      effect->shift_torque(gathered(at, lanes), few);
      for (std::size_t i = 0; i < lanes.size(); ++i) torque[lanes[i]] += few[i];
    }
  }

 private:
  struct Part {
    std::vector<std::size_t> lanes;
    std::unique_ptr<LaneEffect> effect;
  };
  std::vector<Part> groups_;
};

}  // namespace

LaneEffectMaker trial_effect(Effect const& effect, std::vector<std::vector<double>> const& parameters,
                             JointScales const& scales, LaneBaseline const& baseline) {
  TORQUESCOPE_EXPECT(parameters.size() == replicate_lanes);
  std::vector<Group> groups;
  for (std::size_t lane = 0; lane < replicate_lanes; ++lane) {
    auto same = groups.begin();
    while (same != groups.end() && same->parameters != parameters[lane]) ++same;
    if (same == groups.end()) same = groups.insert(groups.end(), {{}, parameters[lane], {}});
    same->lanes.push_back(lane);
  }
  if (groups.size() == 1) return lane_effect(effect, parameters.front(), scales, baseline);
  for (auto& group : groups)
    group.make = lane_effect(effect, group.parameters, scales, gathered(baseline, group.lanes), group.lanes.size());
  return [groups = std::move(groups)] { return std::make_unique<EffectOfTrials>(groups); };
}

}  // namespace torquescope
