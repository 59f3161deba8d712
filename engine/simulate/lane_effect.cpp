#include "engine/simulate/lane_effect.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <utility>

#include "engine/base/contract.hpp"
#include "engine/effects/instant_effect.hpp"
#include "engine/effects/memory_effect.hpp"
#include "kernels/elementary.hpp"

namespace torquescope {
namespace {

using LaneTorques = std::array<double, twin_lanes>;

class CatalogueEffect final : public LaneEffect {
 public:
  CatalogueEffect(Effect const& effect, std::vector<double> const& parameters, JointScales const& scales,
                  LaneJoint const& baseline)
      : acts_on_(effect.acts_on()),
        is_dry_friction_(effect.is_dry_friction()),
        is_partly_dry_(effect.is_partly_dry()),
        has_memory_(effect.has_memory()),
        needs_baseline_(effect.needs_baseline()),
        has_weight_(baseline.gravity_sin != 0.0 || baseline.gravity_cos != 0.0),
        baseline_(baseline),
        parameters_(parameters),
        scales_(scales) {
    if (acts_on_ == ActsOn::joint) law_ = dynamic_cast<InstantEffect const*>(&effect);
    if (law_ != nullptr) return;
    if (auto const* remembering = dynamic_cast<MemoryEffect const*>(&effect)) {
      memory_ = remembering->memory(std::span(parameters_).subspan(effect.n_linear()), scales, twin_lanes);
      linear_ = std::span(parameters_).first(effect.n_linear());
      return;
    }
    for (std::size_t lane = 0; lane < twin_lanes; ++lane) runners_.push_back(effect.runner(parameters, scales));
  }

  // a memory may be stiff: what has none is smooth within a tick
  bool follows_steps() const override { return has_memory_; }

  void add(LaneInstant const& at, LaneDemand& demand) override {
    if (acts_on_ != ActsOn::joint) return;
    LaneTorques const load = load_torques(at);
    advance(at, load);
    LaneInstant trial = at;
    if (is_dry_friction_) return add_sliding(trial, at, load, demand);
    // with the acceleration of the step before, what goes with the acceleration would lag behind it
    std::fill_n(trial.ddq, twin_lanes, 0.0);
    LaneTorques const coasting = torques(trial, load);
    std::fill_n(trial.ddq, twin_lanes, 1.0);
    LaneTorques per_acceleration = torques(trial, load);
    for (std::size_t lane = 0; lane < twin_lanes; ++lane) per_acceleration[lane] -= coasting[lane];
    add_to(demand.inertia, per_acceleration);
    if (!is_partly_dry_) return add_to(demand.smooth, coasting);
    std::fill_n(trial.ddq, twin_lanes, 0.0);
    add_sliding(trial, at, load, demand);
  }

  void shift_position(LaneInstant const& tick, double* position) override {
    if (acts_on_ == ActsOn::recorded_position) shift(tick, position);
  }

  void shift_torque(LaneInstant const& tick, double* torque) override {
    if (acts_on_ == ActsOn::recorded_torque) shift(tick, torque);
  }

 private:
  LaneTorques load_torques(LaneInstant const& at) const {
    LaneTorques load{};
    if (!needs_baseline_) return load;
    for (std::size_t lane = 0; lane < twin_lanes; ++lane) load[lane] = baseline_.inertia * at.ddq[lane];
    if (!has_weight_) return load;
    LaneTorques sine, cosine;
    kernels::cosine_sine_of_multiple(1.0, at.q, twin_lanes, cosine.data(), sine.data());
    for (std::size_t lane = 0; lane < twin_lanes; ++lane)
      load[lane] += baseline_.gravity_sin * sine[lane] + baseline_.gravity_cos * cosine[lane];
    return load;
  }

  static JointState state_of(LaneInstant const& at, LaneTorques const& load, std::size_t lane) {
    return {at.time_s, at.q[lane], at.dq[lane], at.ddq[lane], load[lane], at.motor_torque[lane]};
  }

  void shift(LaneInstant const& tick, double* channel) {
    LaneTorques const load = load_torques(tick);
    advance(tick, load);
    add_to(channel, torques(tick, load));
  }

  void advance(LaneInstant const& at, LaneTorques const& load) {
    LaneTorques time_s;
    if (memory_) memory_->advance(states_of(at, load, time_s), at.step_s);
    for (std::size_t lane = 0; lane < runners_.size(); ++lane)
      runners_[lane]->advance(state_of(at, load, lane), at.step_s);
  }

  // time_s: room for what the lanes have in common
  static JointStates states_of(LaneInstant const& at, LaneTorques const& load, LaneTorques& time_s) {
    time_s.fill(at.time_s);
    auto const of_lanes = [](double const* values) { return JointStates::Quantity(values, twin_lanes); };
    return {of_lanes(time_s.data()), of_lanes(at.q),        of_lanes(at.dq),
            of_lanes(at.ddq),        of_lanes(load.data()), of_lanes(at.motor_torque)};
  }

  static void add_to(double* sum, LaneTorques const& torque) {
    for (std::size_t lane = 0; lane < twin_lanes; ++lane) sum[lane] += torque[lane];
  }

  // memory as it stands
  LaneTorques torques(LaneInstant const& at, LaneTorques const& load) const {
    LaneTorques found{};
    LaneTorques time_s;
    JointStates const states = states_of(at, load, time_s);
    if (law_ != nullptr)
      law_->torques(states, parameters_, scales_, found);
    else if (memory_)
      memory_->torques(states, linear_, found);
    else
      for (std::size_t lane = 0; lane < twin_lanes; ++lane)
        found[lane] = runners_[lane]->torque(state_of(at, load, lane));
    return found;
  }

  void add_sliding(LaneInstant& trial, LaneInstant const& at, LaneTorques const& load, LaneDemand& demand) const {
    add_to(demand.forward, sliding(trial, at, load, 1.0));
    add_to(demand.backward, sliding(trial, at, load, -1.0));
  }

  // the branch that moves in `direction`, continued to rest
  LaneTorques sliding(LaneInstant& trial, LaneInstant const& at, LaneTorques const& load, double direction) const {
    for (std::size_t lane = 0; lane < twin_lanes; ++lane)
      trial.dq[lane] = direction * std::max(direction * at.dq[lane], std::numeric_limits<double>::min());
    return torques(trial, load);
  }

  ActsOn acts_on_;
  bool is_dry_friction_, is_partly_dry_, has_memory_, needs_baseline_, has_weight_;
  LaneJoint baseline_;
  std::vector<double> parameters_;
  JointScales scales_;
  // all lanes at once: a law of the instant in the joint, or what each twin remembers
  InstantEffect const* law_ = nullptr;
  std::unique_ptr<EffectMemory> memory_;
  std::span<double const> linear_{};                    // of parameters_
  std::vector<std::unique_ptr<EffectRunner>> runners_;  // otherwise one per lane
};

}  // namespace

LaneEffectMaker lane_effect(Effect const& effect, std::vector<double> parameters, JointScales const& scales,
                            LaneJoint const& baseline) {
  TORQUESCOPE_EXPECT(parameters.size() >= effect.n_linear());
  TORQUESCOPE_EXPECT(effect.takes_shape(parameters.size() - effect.n_linear()));
  return [&effect, parameters = std::move(parameters), scales, baseline] {
    return std::make_unique<CatalogueEffect>(effect, parameters, scales, baseline);
  };
}

}  // namespace torquescope
