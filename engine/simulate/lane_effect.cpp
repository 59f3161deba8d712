#include "engine/simulate/lane_effect.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "engine/base/contract.hpp"

namespace torquescope {
namespace {

// one runner per lane: each twin has its own memory
class CatalogueEffect final : public LaneEffect {
 public:
  CatalogueEffect(Effect const& effect, std::vector<double> const& parameters, JointScales const& scales,
                  LaneJoint const& baseline)
      : acts_on_(effect.acts_on()),
        is_dry_friction_(effect.is_dry_friction()),
        has_memory_(effect.has_memory()),
        needs_baseline_(effect.needs_baseline()),
        has_weight_(baseline.gravity_sin != 0.0 || baseline.gravity_cos != 0.0),
        baseline_(baseline) {
    for (std::size_t lane = 0; lane < twin_lanes; ++lane) runners_.push_back(effect.runner(parameters, scales));
  }

  // a memory may be stiff: what has none is smooth within a tick
  bool follows_steps() const override { return has_memory_; }

  void add(LaneInstant const& at, LaneDemand& demand) override {
    if (acts_on_ != ActsOn::joint) return;
    for (std::size_t lane = 0; lane < twin_lanes; ++lane) {
      JointState const state = state_of(at, lane);
      runners_[lane]->advance(state, at.step_s);
      if (is_dry_friction_) {
        demand.forward[lane] += sliding(*runners_[lane], state, 1.0);
        demand.backward[lane] += sliding(*runners_[lane], state, -1.0);
      } else {
        // with the acceleration of the step before, what goes with the acceleration would lag behind it
        double const coasting = at_acceleration(*runners_[lane], state, 0.0);
        demand.smooth[lane] += coasting;
        demand.inertia[lane] += at_acceleration(*runners_[lane], state, 1.0) - coasting;
      }
    }
  }

  void shift_position(LaneInstant const& tick, double* position) override {
    if (acts_on_ == ActsOn::recorded_position) shift(tick, position);
  }

  void shift_torque(LaneInstant const& tick, double* torque) override {
    if (acts_on_ == ActsOn::recorded_torque) shift(tick, torque);
  }

 private:
  JointState state_of(LaneInstant const& at, std::size_t lane) const {
    JointState state{at.time_s, at.q[lane], at.dq[lane], at.ddq[lane]};
    state.motor_torque = at.motor_torque[lane];
    if (!needs_baseline_) return state;
    state.load_torque = baseline_.inertia * state.ddq;
    if (has_weight_)
      state.load_torque += baseline_.gravity_sin * std::sin(state.q) + baseline_.gravity_cos * std::cos(state.q);
    return state;
  }

  void shift(LaneInstant const& tick, double* channel) {
    for (std::size_t lane = 0; lane < twin_lanes; ++lane)
      channel[lane] += runners_[lane]->torque(state_of(tick, lane), tick.step_s);
  }

  static double at_acceleration(EffectRunner const& runner, JointState state, double ddq) {
    state.ddq = ddq;
    return runner.torque(state);
  }

  // the branch that moves in `direction`, continued to rest
  static double sliding(EffectRunner const& runner, JointState state, double direction) {
    state.dq = direction * std::max(direction * state.dq, std::numeric_limits<double>::min());
    return runner.torque(state);
  }

  ActsOn acts_on_;
  bool is_dry_friction_, has_memory_, needs_baseline_, has_weight_;
  LaneJoint baseline_;
  std::vector<std::unique_ptr<EffectRunner>> runners_;
};

}  // namespace

LaneEffectMaker lane_effect(Effect const& effect, std::vector<double> parameters, JointScales const& scales,
                            LaneJoint const& baseline) {
  TORQUESCOPE_EXPECT(parameters.size() == effect.parameters().size());
  return [&effect, parameters = std::move(parameters), scales, baseline] {
    return std::make_unique<CatalogueEffect>(effect, parameters, scales, baseline);
  };
}

}  // namespace torquescope
