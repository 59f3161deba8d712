#include "engine/simulate/lane_effect.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <optional>
#include <utility>

#include "engine/base/contract.hpp"
#include "engine/effects/instant_code.hpp"
#include "engine/effects/instant_effect.hpp"
#include "engine/effects/memory_effect.hpp"
#include "engine/simulate/lane_step.hpp"
#include "kernels/elementary.hpp"

namespace torquescope {
namespace {

// straight from tick to tick, constant beyond the ends
double between_ticks(Eigen::Ref<Eigen::VectorXd const> const& signal, double ticks) {
  double const tick = std::clamp(ticks, 0.0, static_cast<double>(signal.size() - 1));
  auto const before = static_cast<Eigen::Index>(tick), after = std::min(before + 1, signal.size() - 1);
  return signal[before] + (tick - static_cast<double>(before)) * (signal[after] - signal[before]);
}

using LaneTorques = std::array<double, replicate_lanes>;

// the same in all lanes
constexpr LaneTorques filled(double value) {
  LaneTorques all{};
  for (double& lane : all) lane = value;
  return all;
}
constexpr LaneTorques none = filled(0.0), one = filled(1.0);

std::vector<double> row_of(Eigen::ArrayXXd const& parameters, std::size_t lane) {
  Eigen::ArrayXd const row = parameters.row(static_cast<Eigen::Index>(lane)).transpose();
  return {row.begin(), row.end()};
}

bool are_alike(Eigen::ArrayXXd const& parameters) {
  return (parameters == parameters.row(0).replicate(parameters.rows(), 1)).all();
}

// asked of the effect itself, so that no table can disagree; what begins at an instant may do so then
bool asks_for_acceleration(InstantEffect const& effect, std::vector<double> const& parameters,
                           JointScales const& scales) {
  if (effect.is_event()) return true;
  JointState const coasts{0.0, 0.4, -0.7, 0.0, 1.2, -0.8};
  JointState speeds_up = coasts;
  speeds_up.ddq = 1.0;
  return effect.torque(speeds_up, parameters, scales) != effect.torque(coasts, parameters, scales);
}

// its code names all that it reads; what depends on the time or the past has none
bool is_of_speed_alone(InstantEffect const& effect) {
  auto const reads = [&](char const* word) { return has_word(effect.code(), word); };
  return !effect.code().empty() && !reads("q") && !reads("ddq") && !reads("load");
}

class CatalogueEffect final : public LaneEffect {
 public:
  // parameters: [lane][parameter]
  CatalogueEffect(Effect const& effect, Eigen::ArrayXXd const& parameters, JointScales const& scales,
                  LaneBaseline const& baseline)
      : acts_on_(effect.acts_on()),
        is_dry_friction_(effect.is_dry_friction()),
        is_partly_dry_(effect.is_partly_dry()),
        has_memory_(effect.has_memory()),
        needs_baseline_(effect.needs_baseline()),
        has_weight_(baseline.joint.has_weight),
        baseline_(baseline.joint),
        gear_load_(baseline.gear_load),
        gear_load_rate_hz_(baseline.rate_hz),
        parameters_(parameters),
        scales_(scales) {
    if (are_alike(parameters_)) common_ = row_of(parameters_, 0);
    if (acts_on_ == ActsOn::joint) effect_ = dynamic_cast<InstantEffect const*>(&effect);
    if (effect_ != nullptr) {
      asks_for_acceleration_ = any_asks_for_acceleration();
      if (is_of_speed_alone(*effect_)) rest_ = Rest{at_rest(1.0), at_rest(-1.0)};
      return;
    }
    if (auto const* remembering = dynamic_cast<MemoryEffect const*>(&effect)) {
      memory_ = memory_of_lanes(*remembering);
      linear_ = parameters_.leftCols(static_cast<Eigen::Index>(effect.n_linear()));
      return;
    }
    for (std::size_t lane = 0; lane < replicate_lanes; ++lane)
      runners_.push_back(effect.runner(row_of(parameters_, lane), scales));
  }

  // a memory may be stiff: what has none is smooth within a tick
  bool follows_steps() const override { return has_memory_; }
  bool shifts_channels() const override { return acts_on_ != ActsOn::joint; }

  void add(LaneInstant const& at, LaneDemand& demand) override {
    if (acts_on_ != ActsOn::joint) return;
    Borne const borne = borne_at(at, at.time_s);
    LaneTorques time_s;
    JointStates const now = states_of(at, borne, time_s);
    advance(now, at.step_s);
    if (is_dry_friction_) return add_sliding(now, demand);
    // with the acceleration of the step before, what goes with the acceleration would lag behind it
    JointStates const coasts = accelerated(now, none);
    LaneTorques const coasting = torques(coasts);
    LaneTorques const at_one = asks_for_acceleration_ ? torques(accelerated(now, one)) : coasting;
    if (!is_partly_dry_) return add_straight(coasting.data(), at_one.data(), demand);
    for (std::size_t lane = 0; lane < replicate_lanes; ++lane) demand.inertia[lane] += at_one[lane] - coasting[lane];
    add_sliding(coasts, demand);
  }

  void shift_position(LaneInstant const& tick, double* position) override {
    if (acts_on_ == ActsOn::recorded_position) shift(tick, position);
  }

  void shift_torque(LaneInstant const& tick, double* torque) override {
    if (acts_on_ == ActsOn::recorded_torque) shift(tick, torque);
  }

 private:
  bool any_asks_for_acceleration() const {
    if (common_) return asks_for_acceleration(*effect_, *common_, scales_);
    for (std::size_t lane = 0; lane < replicate_lanes; ++lane)
      if (asks_for_acceleration(*effect_, row_of(parameters_, lane), scales_)) return true;
    return false;
  }

  std::unique_ptr<EffectMemory> memory_of_lanes(MemoryEffect const& effect) const {
    auto const of = [&](std::vector<double> const& all, std::size_t lanes) {
      return effect.memory(std::span(all).subspan(effect.n_linear()), scales_, lanes);
    };
    if (common_) return of(*common_, replicate_lanes);
    auto memory = of(row_of(parameters_, 0), 1);
    for (std::size_t lane = 1; lane < replicate_lanes; ++lane) memory->append(*of(row_of(parameters_, lane), 1));
    return memory;
  }

  // what needs a baseline is told of the whole torque: at the gear, and of the motor
  struct Borne {
    LaneTorques load{}, motor{};
  };

  // motor_at_s: of the gear load, when the motor's torque is read
  Borne borne_at(LaneInstant const& at, double motor_at_s) const {
    Borne borne;
    std::copy_n(at.motor_torque, replicate_lanes, borne.motor.begin());
    if (!needs_baseline_) return borne;
    double const beside = gear_load_at(at.time_s), in_motor = gear_load_at(motor_at_s);
    for (std::size_t lane = 0; lane < replicate_lanes; ++lane) {
      borne.load[lane] = beside + baseline_.inertia[lane] * at.ddq[lane];
      borne.motor[lane] += in_motor;
    }
    if (!has_weight_) return borne;
    LaneTorques sine, cosine;
    kernels::cosine_sine_of_multiple(1.0, at.q, replicate_lanes, cosine.data(), sine.data());
    for (std::size_t lane = 0; lane < replicate_lanes; ++lane)
      borne.load[lane] += baseline_.gravity_sin[lane] * sine[lane] + baseline_.gravity_cos[lane] * cosine[lane];
    return borne;
  }

  // straight from tick to tick
  double gear_load_at(double time_s) const {
    return gear_load_ ? between_ticks(*gear_load_, time_s * gear_load_rate_hz_) : 0.0;
  }

  void shift(LaneInstant const& tick, double* channel) {
    // a channel shows the torque that is held from the tick on: that of its middle (held_torque.hpp)
    Borne const borne = borne_at(tick, tick.time_s + 0.5 * tick.step_s);
    LaneTorques time_s;
    JointStates const now = states_of(tick, borne, time_s);
    advance(now, tick.step_s);
    add_lanes(torques(now).data(), channel);
  }

  void advance(JointStates const& at, double step_s) {
    if (memory_) memory_->advance(at, step_s);
    for (std::size_t lane = 0; lane < runners_.size(); ++lane) runners_[lane]->advance(at.state(lane), step_s);
  }

  static JointStates::Quantity of_lanes(double const* values) {
    return {values, static_cast<Eigen::Index>(replicate_lanes)};
  }

  // time_s: room for what the lanes have in common
  JointStates states_of(LaneInstant const& at, Borne const& borne, LaneTorques& time_s) const {
    time_s.fill(at.time_s);
    return {of_lanes(time_s.data()),     of_lanes(at.q), of_lanes(at.dq), of_lanes(at.ddq), of_lanes(borne.load.data()),
            of_lanes(borne.motor.data())};
  }

  JointStates accelerated(JointStates const& at, LaneTorques const& ddq) const {
    return {at.time_s, at.q, at.dq, of_lanes(ddq.data()), at.load_torque, at.motor_torque};
  }

  // memory as it stands
  LaneTorques torques(JointStates const& at) const {
    LaneTorques found{};
    if (effect_ != nullptr && common_)
      effect_->torques(at, *common_, scales_, found);
    else if (effect_ != nullptr)
      effect_->torques_of_each(at, parameters_, scales_, found);
    else if (memory_)
      memory_->torques(at, linear_, found);
    else
      for (std::size_t lane = 0; lane < replicate_lanes; ++lane) found[lane] = runners_[lane]->torque(at.state(lane));
    return found;
  }

  void add_sliding(JointStates const& at, LaneDemand& demand) const {
    add_lanes(sliding(at, 1.0).data(), demand.forward);
    add_lanes(sliding(at, -1.0).data(), demand.backward);
  }

  static constexpr double slowest = std::numeric_limits<double>::min();

  // the branch that moves in `direction`, continued to rest
  LaneTorques sliding(JointStates const& at, double direction) const {
    if (rest_ && !(direction * at.dq > slowest).any()) return direction > 0.0 ? rest_->forward : rest_->backward;
    LaneTorques dq{};
    for (std::size_t lane = 0; lane < replicate_lanes; ++lane)
      dq[lane] = direction * std::max(direction * at.dq[static_cast<Eigen::Index>(lane)], slowest);
    return torques({at.time_s, at.q, of_lanes(dq.data()), at.ddq, at.load_torque, at.motor_torque});
  }

  LaneTorques at_rest(double direction) const {
    LaneTorques const dq = filled(direction * slowest);
    auto const nothing = of_lanes(none.data());
    return torques({nothing, nothing, of_lanes(dq.data()), nothing, nothing, nothing});
  }

  // most often all lanes move one way: what the other branch begins with, of effects of the speed alone
  struct Rest {
    LaneTorques forward, backward;
  };

  ActsOn acts_on_;
  bool is_dry_friction_, is_partly_dry_, has_memory_, needs_baseline_, has_weight_;
  bool asks_for_acceleration_ = true;  // whatever is remembered may
  LaneJoints baseline_;
  std::shared_ptr<Eigen::VectorXd const> gear_load_;
  double gear_load_rate_hz_;
  Eigen::ArrayXXd parameters_;                   // [lane][parameter]
  std::optional<std::vector<double>> common_{};  // of all lanes; none where they differ
  JointScales scales_;
  // all lanes at once: an effect of the instant in the joint, or what each replicate remembers
  InstantEffect const* effect_ = nullptr;
  std::optional<Rest> rest_{};
  std::unique_ptr<EffectMemory> memory_;
  Eigen::ArrayXXd linear_{};                            // of parameters_
  std::vector<std::unique_ptr<EffectRunner>> runners_;  // otherwise one per lane
};

}  // namespace

namespace {

// a torque known beforehand, straight from tick to tick: [tick][lane], or one column for all lanes
class KnownTorque final : public LaneEffect {
 public:
  KnownTorque(std::shared_ptr<Eigen::MatrixXd const> torque, double rate_hz)
      : torque_(std::move(torque)), rate_hz_(rate_hz) {}
  bool follows_steps() const override { return false; }
  void add(LaneInstant const& at, LaneDemand& demand) override {
    double const ticks = at.time_s * rate_hz_, first = between_ticks(torque_->col(0), ticks);
    bool const is_common = torque_->cols() == 1;
    for (std::size_t lane = 0; lane < replicate_lanes; ++lane)
      demand.smooth[lane] += is_common ? first : between_ticks(torque_->col(static_cast<Eigen::Index>(lane)), ticks);
  }

 private:
  std::shared_ptr<Eigen::MatrixXd const> torque_;
  double rate_hz_;
};

LaneEffectMaker known_torque(Effect const& effect, Eigen::ArrayXXd const& parameters, LaneBaseline const& baseline) {
  Eigen::MatrixXd const* columns = baseline.given ? baseline.given->of(effect.name()) : nullptr;
  Eigen::Index const lanes = are_alike(parameters) ? 1 : parameters.rows();
  auto torque = std::make_shared<Eigen::MatrixXd const>(
      columns == nullptr ? Eigen::MatrixXd::Zero(1, 1).eval()
                         : Eigen::MatrixXd(*columns * parameters.topRows(lanes).matrix().transpose()));
  return [torque, rate_hz = baseline.rate_hz] { return std::make_unique<KnownTorque>(torque, rate_hz); };
}

}  // namespace

LaneEffectMaker lane_effect(Effect const& effect, std::vector<double> const& parameters, JointScales const& scales,
                            LaneBaseline const& baseline) {
  Eigen::Map<Eigen::ArrayXd const> const each(parameters.data(), static_cast<Eigen::Index>(parameters.size()));
  return lane_effect_of_each(effect, each.transpose().replicate(replicate_lanes, 1), scales, baseline);
}

LaneEffectMaker lane_effect_of_each(Effect const& effect, Eigen::ArrayXXd parameters, JointScales const& scales,
                                    LaneBaseline const& baseline) {
  auto const count = static_cast<std::size_t>(parameters.cols());
  TORQUESCOPE_EXPECT(parameters.rows() == static_cast<Eigen::Index>(replicate_lanes) && count >= effect.n_linear());
  TORQUESCOPE_EXPECT(effect.takes_shape(count - effect.n_linear()));
  if (effect.is_given()) return known_torque(effect, parameters, baseline);
  return [&effect, parameters = std::move(parameters), scales, baseline] {
    return std::make_unique<CatalogueEffect>(effect, parameters, scales, baseline);
  };
}

}  // namespace torquescope
