#include "engine/simulate/lane_effect.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include "engine/base/contract.hpp"

namespace torquescope {
namespace {

class MemorylessEffect final : public LaneEffect {
 public:
  MemorylessEffect(Effect const& effect, std::vector<double> parameters)
      : effect_(effect), parameters_(std::move(parameters)) {}

  void add(LaneInstant const& at, LaneDemand& demand) override {
    for (std::size_t lane = 0; lane < twin_lanes; ++lane) {
      JointState const state{at.time_s, at.q[lane], at.dq[lane], at.ddq[lane]};
      if (effect_.is_dry_friction()) {
        demand.forward[lane] += sliding(state, 1.0);
        demand.backward[lane] += sliding(state, -1.0);
      } else {
        demand.smooth[lane] += effect_.torque(state, parameters_);
      }
    }
  }

 private:
  // the branch that moves in `direction`, continued to rest
  double sliding(JointState state, double direction) const {
    state.dq = direction * std::max(direction * state.dq, std::numeric_limits<double>::min());
    return effect_.torque(state, parameters_);
  }

  Effect const& effect_;
  std::vector<double> parameters_;
};

}  // namespace

LaneEffectMaker lane_effect(Effect const& effect, std::vector<double> parameters) {
  TORQUESCOPE_EXPECT(parameters.size() == effect.parameters().size());
  return
      [&effect, parameters = std::move(parameters)] { return std::make_unique<MemorylessEffect>(effect, parameters); };
}

}  // namespace torquescope
