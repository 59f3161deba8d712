#include "engine/simulate/arm_simulation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "engine/base/contract.hpp"
#include "engine/base/digest.hpp"
#include "engine/robot/base_parameters.hpp"
#include "engine/simulate/closed_loop.hpp"
#include "engine/simulate/joint_loop.hpp"

namespace torquescope {

namespace {

using Eigen::Index;

constexpr std::uint32_t runs_between_joints = 4096;

RandomKey key_of_joint(RandomKey key, std::size_t joint) {
  key.run += runs_between_joints * static_cast<std::uint32_t>(joint);
  return key;
}

// references of all joints at one instant
struct ArmPoint {
  std::vector<ReferencePoint> joints;

  Eigen::VectorXd column(double ReferencePoint::*quantity) const {
    Eigen::VectorXd values(static_cast<Index>(joints.size()));
    for (std::size_t j = 0; j < joints.size(); ++j) values[static_cast<Index>(j)] = joints[j].*quantity;
    return values;
  }
};

class ArmReference {
 public:
  ArmReference(ArmSimulationPlan const& plan, RandomKey const& key) {
    for (std::size_t j = 0; j < plan.joints.size(); ++j)
      joints_.push_back(
          plan.motions.empty()
              ? make_reference(plan.joints[j].reference, plan.simulation.duration_s, key_of_joint(key, j))
              : sampled_reference(plan.motions[std::min<std::size_t>(key.run, plan.motions.size() - 1)][j]));
  }
  ArmPoint at(double time_s) const {
    ArmPoint point;
    for (auto const& joint : joints_) point.joints.push_back(joint->at(time_s));
    return point;
  }

 private:
  std::vector<std::unique_ptr<Reference const>> joints_;
};

ArmPlant plant_of(ArmSimulationPlan const& plan) {
  std::vector<ArmJointTerms> terms;
  for (auto const& joint : plan.joints) terms.push_back(joint.terms);
  return {plan.chain, standard_parameters(plan.chain, DriveInertias::included), terms};
}

// joints are finite and somewhere near where they should be, or nothing that follows means anything
void validate_loop(ArmState const& state, ArmPoint const& wanted, std::vector<double> const& farthest) {
  for (std::size_t j = 0; j < farthest.size(); ++j) {
    double const distance = std::abs(state.q[static_cast<Index>(j)] - wanted.joints[j].q);
    validate(distance <= farthest[j], [&] {
      Problem problem;
      problem.what =
          fmt::format("the simulated loop is unstable: at {:.4g} s joint {} is {:.3g} away from its reference",
                      state.time_s, j + 1, distance);
      problem.key = "simulate.controller";
      problem.help = "lower the gains, bandwidth_hz or delay_ticks, or raise the controller's rate_hz";
      return problem;
    });
  }
}

void resize(SimulatedRecording& recording, Index samples, bool exact) {
  for (auto* channel : {&recording.time_s, &recording.position, &recording.torque, &recording.true_velocity,
                        &recording.true_acceleration, &recording.true_torque})
    channel->resize(samples);
  if (exact) return;
  recording.reference.resize(samples);
  recording.true_position.resize(samples);
}

void record_exact(ArmSimulationPlan const& plan, ArmReference const& reference, RandomKey const& key,
                  SimulatedArm& arm) {
  ArmPlant plant = plant_of(plan);
  std::vector<JointLoop> noises;
  for (std::size_t j = 0; j < plan.joints.size(); ++j) {
    auto const& joint = plan.joints[j];
    double const rate_hz = plan.simulation.rate_hz;
    noises.emplace_back(JointLoopOptions{joint.controller, joint.encoder, joint.noise, rate_hz, rate_hz},
                        key_of_joint(key, j), 1.0, ReferencePoint{});
  }
  for (Index i = 0; i < plan.simulation.samples(); ++i) {
    double const time_s = static_cast<double>(i) / plan.simulation.rate_hz;
    ArmPoint const at = reference.at(time_s);
    ArmState const state{time_s, at.column(&ReferencePoint::q), at.column(&ReferencePoint::dq)};
    Eigen::VectorXd const torque = plant.inverse_dynamics(state, at.column(&ReferencePoint::ddq));
    for (std::size_t j = 0; j < arm.joints.size(); ++j) {
      auto& joint = arm.joints[j];
      double const true_torque = torque[static_cast<Index>(j)];
      joint.time_s[i] = time_s;
      joint.position[i] = at.joints[j].q;
      joint.true_velocity[i] = at.joints[j].dq;
      joint.true_acceleration[i] = at.joints[j].ddq;
      joint.true_torque[i] = true_torque;
      joint.torque[i] = noises[j].logged({at.joints[j].q, true_torque, true_torque});
    }
  }
}

void record_loop(ArmSimulationPlan const& plan, ArmReference const& reference, RandomKey const& key,
                 SimulatedArm& arm) {
  // sizes
  double const rate_hz = controller_rate_hz(plan.joints.front().controller, plan.simulation.rate_hz);
  Index const ticks_per_sample = std::llround(rate_hz / plan.simulation.rate_hz);
  double const substeps = std::ceil(1.0 / (rate_hz * plan.simulation.step_s) * (1.0 - 1e-9));
  double const step_s = 1.0 / (rate_hz * substeps);
  auto const n = static_cast<Index>(plan.joints.size());

  // the loops' parts
  ArmPlant plant = plant_of(plan);
  ArmPoint const start = reference.at(0.0);
  ArmState state{0.0, start.column(&ReferencePoint::q), start.column(&ReferencePoint::dq)};
  Eigen::VectorXd const inertia = plant.inertia(state);
  std::vector<JointLoop> loops;
  std::vector<double> farthest;
  bool is_fed_forward = false;
  for (std::size_t j = 0; j < plan.joints.size(); ++j) {
    auto const& joint = plan.joints[j];
    loops.emplace_back(JointLoopOptions{joint.controller, joint.encoder, joint.noise, rate_hz, plan.simulation.rate_hz},
                       key_of_joint(key, j), inertia[static_cast<Index>(j)], start.joints[j]);
    double const size =
        plan.motions.empty() ? joint.reference.amplitude : plan.motions.front()[j].q.cwiseAbs().maxCoeff();
    farthest.push_back(100.0 * std::max(size, 1e-2));
    is_fed_forward = is_fed_forward || joint.controller.feedforward;
    arm.joints[j].gains = loops[j].gains();
    arm.joints[j].controller_rate_hz = rate_hz;
  }

  Eigen::VectorXd acting(n), model = Eigen::VectorXd::Zero(n);
  std::vector<LoopTick> now(plan.joints.size());
  for (Index tick = 0; tick < plan.simulation.samples() * ticks_per_sample; ++tick) {
    // measure and answer
    state.time_s = static_cast<double>(tick) / rate_hz;
    ArmPoint const wanted = reference.at(state.time_s);
    validate_loop(state, wanted, farthest);
    if (is_fed_forward)
      model =
          plant.inverse_dynamics({state.time_s, wanted.column(&ReferencePoint::q), wanted.column(&ReferencePoint::dq)},
                                 wanted.column(&ReferencePoint::ddq));
    for (std::size_t j = 0; j < loops.size(); ++j) {
      auto const at = static_cast<Index>(j);
      now[j] = loops[j].tick(wanted.joints[j], state.q[at], model[at]);
      acting[at] = now[j].acting;
    }

    // write down
    if (tick % ticks_per_sample == 0) {
      Eigen::VectorXd const& acceleration = plant.acceleration(state, acting);
      Index const i = tick / ticks_per_sample;
      for (std::size_t j = 0; j < loops.size(); ++j) {
        auto const at = static_cast<Index>(j);
        record_sample(arm.joints[j], i, {state.time_s, state.q[at], state.dq[at], acceleration[at]}, wanted.joints[j],
                      now[j].measured, loops[j].logged(now[j]), now[j].acting);
        arm.joints[j].saturated_samples += loops[j].is_saturated(now[j]);
      }
    }
    for (std::size_t j = 0; j < loops.size(); ++j) loops[j].pass(now[j]);

    // move on to the next tick
    for (double k = 0.0; k < substeps; ++k) plant.advance(state, acting, step_s);
  }
}

// "q_rad" of joint 2: "q2_rad"
std::string numbered(std::string const& column, std::size_t joint) {
  // the unit is behind the name: tau_Nm, q_ref_rad, dq_true_rad_s
  auto const unit = std::min({column.rfind("_rad"), column.rfind("_Nm"), column.rfind("_N"), column.rfind("_m")});
  std::string text = column;
  return text.insert(unit, std::to_string(joint));
}

}  // namespace

SimulatedArm simulate_arm(ArmSimulationPlan const& plan, std::uint64_t experiment_seed, std::uint32_t index) {
  TORQUESCOPE_EXPECT(plan.joints.size() == plan.chain.joints.size() && index < runs_between_joints);
  RandomKey const key{plan.simulation.seed >= 0 ? static_cast<std::uint64_t>(plan.simulation.seed) : experiment_seed,
                      index, RandomDomain::simulation};
  bool const exact = plan.simulation.mode == "inverse_dynamics";
  SimulatedArm arm;
  arm.name = index == 0 ? "simulated" : "simulated_unseen";
  for (std::size_t j = 0; j < plan.joints.size(); ++j) {
    SimulatedRecording recording;
    recording.name = arm.name;
    recording.joint = plan.chain.joints[j].kind;
    recording.rate_hz = plan.simulation.rate_hz;
    recording.has_exact_motion = exact;
    resize(recording, plan.simulation.samples(), exact);
    arm.joints.push_back(std::move(recording));
  }

  ArmReference const reference(plan, key);
  if (exact)
    record_exact(plan, reference, key, arm);
  else
    record_loop(plan, reference, key, arm);

  Digest digest;
  for (auto& joint : arm.joints) {
    joint.sha256 = digest_of(joint);
    digest.text(joint.sha256);
  }
  arm.sha256 = digest.hex();
  return arm;
}

std::vector<SimulatedColumn> columns(SimulatedArm const& arm) {
  std::vector<SimulatedColumn> all;
  for (std::size_t j = 0; j < arm.joints.size(); ++j)
    for (auto column : columns(arm.joints[j])) {
      if (column.channel == "time" && j > 0) continue;
      if (column.channel != "time") column.name = numbered(column.name, j + 1);
      all.push_back(std::move(column));
    }
  return all;
}

std::vector<TruthValue> truth_values(ArmSimulationPlan const& plan) {
  BaseParameters const base(plan.chain, DriveInertias::included);
  Eigen::VectorXd const values = base.from_standard(standard_parameters(plan.chain, DriveInertias::included));
  std::vector<TruthValue> all;
  for (Index k = 0; k < base.size(); ++k) {
    auto const& parameter = base.parameters()[static_cast<std::size_t>(k)];
    all.push_back({parameter.name, parameter.unit, values[k]});
  }
  for (std::size_t j = 0; j < plan.joints.size(); ++j)
    for (auto const* terms : {&plan.joints[j].terms.instant, &plan.joints[j].terms.remembering})
      for (auto value : truth_values(*terms, plan.chain.joints[j].kind)) {
        value.name += fmt::format("_{}", j + 1);
        all.push_back(std::move(value));
      }
  return all;
}

}  // namespace torquescope
