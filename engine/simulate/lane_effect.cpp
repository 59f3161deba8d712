#include "engine/simulate/lane_effect.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include "engine/base/contract.hpp"

namespace torquescope {
namespace {

// one runner per lane: each twin has its own memory
class JointEffect final : public LaneEffect {
 public:
  JointEffect(Effect const& effect, std::vector<double> const& parameters, JointScales const& scales)
      : is_dry_friction_(effect.is_dry_friction()) {
    for (std::size_t lane = 0; lane < twin_lanes; ++lane) runners_.push_back(effect.runner(parameters, scales));
  }

  void add(LaneInstant const& at, LaneDemand& demand) override {
    for (std::size_t lane = 0; lane < twin_lanes; ++lane) {
      JointState state{at.time_s, at.q[lane], at.dq[lane], at.ddq[lane]};
      state.motor_torque = at.motor_torque[lane];
      runners_[lane]->advance(state, at.step_s);
      if (is_dry_friction_) {
        demand.forward[lane] += sliding(*runners_[lane], state, 1.0);
        demand.backward[lane] += sliding(*runners_[lane], state, -1.0);
      } else {
        demand.smooth[lane] += std::as_const(*runners_[lane]).torque(state);
      }
    }
  }

 private:
  // the branch that moves in `direction`, continued to rest
  static double sliding(EffectRunner const& runner, JointState state, double direction) {
    state.dq = direction * std::max(direction * state.dq, std::numeric_limits<double>::min());
    return runner.torque(state);
  }

  bool is_dry_friction_;
  std::vector<std::unique_ptr<EffectRunner>> runners_;
};

}  // namespace

LaneEffectMaker lane_effect(Effect const& effect, std::vector<double> parameters, JointScales const& scales) {
  TORQUESCOPE_EXPECT(parameters.size() == effect.parameters().size());
  TORQUESCOPE_EXPECT(effect.acts_on() == ActsOn::joint);
  return [&effect, parameters = std::move(parameters), scales] {
    return std::make_unique<JointEffect>(effect, parameters, scales);
  };
}

}  // namespace torquescope
