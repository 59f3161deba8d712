#include "engine/experiment/arm_instruments.hpp"

#include <fmt/format.h>

#include <utility>

#include "engine/base/error.hpp"
#include "engine/fit/problem/arm_regression.hpp"
#include "engine/simulate/arm_replicate.hpp"
#include "engine/simulate/arm_simulation_plan.hpp"
#include "engine/simulate/controller_fit.hpp"

namespace torquescope {

namespace {

using Eigen::Index;
using Eigen::VectorXd;

// its branches hold the joint: what noise has turned round drives it, and no arm has that
bool brakes(PlantTerm const& term) {
  if (!term.effect->is_dry_friction()) return true;
  JointEffects const effect({term});
  return effect.dry({}, -1.0) <= effect.dry({}, 1.0);
}

std::vector<Effect const*> friction_terms(ArmModel const& model, std::size_t joint) {
  auto const& friction = model.friction()[joint];
  return friction ? friction->terms() : std::vector<Effect const*>();
}

ArmPlant plant_of(ArmModel const& model, VectorXd const& parameters) {
  Index next = model.base().size();
  std::vector<ArmJointTerms> joints(model.joints());
  for (std::size_t j = 0; j < model.friction().size(); ++j)
    for (Effect const* effect : friction_terms(model, j)) {
      PlantTerm term{effect, {}};
      for (std::size_t k = 0; k < effect->n_linear(); ++k) term.parameters.push_back(parameters[next++]);
      if (brakes(term)) joints[j].instant.push_back(std::move(term));
    }
  return {model.chain(), model.base().to_standard(parameters.head(model.base().size())), joints};
}

std::vector<Motion> motion_of(ArmTrack const& track, VectorXd Recording::*position, InstrumentPlan const& plan) {
  std::vector<Motion> motion;
  for (auto const& joint : track.joints) {
    Recording moved;
    moved.rate_hz = joint.rate_hz;
    moved.time_s = joint.time_s;
    moved.position = joint.*position;
    moved.torque.setZero(joint.time_s.size());
    moved.left_out = joint.left_out;
    motion.push_back(differentiate(std::move(moved), plan.filter, plan.section));
  }
  return motion;
}

// [n][N] what the arm needs on its references
Eigen::MatrixXd needed_torque(ArmPlant plant, ArmTrack const& track, InstrumentPlan const& plan) {
  auto const motion = motion_of(track, &Recording::reference, plan);
  Index const n = motion.front().q.size(), joints = plant.size();
  Eigen::MatrixXd torque(n, joints);
  ArmState state{0.0, VectorXd(joints), VectorXd(joints)};
  VectorXd push(joints);
  for (Index i = 0; i < n; ++i) {
    for (Index j = 0; j < joints; ++j) {
      auto const& joint = motion[static_cast<std::size_t>(j)];
      state.q[j] = joint.q[i];
      state.dq[j] = joint.dq[i];
      push[j] = joint.ddq[i];
    }
    torque.row(i) = plant.inverse_dynamics(state, push).transpose();
  }
  return torque;
}

ArmJointLoop loop_of(Recording const& joint, VectorXd const& needed) {
  auto const fit = [&](VectorXd const& torque) {
    return fit_controller({joint.time_s, joint.reference, joint.position, torque});
  };
  auto const alone = fit(joint.torque), beside = fit(joint.torque - needed);
  bool const is_fed_forward = beside.noise.std < alone.noise.std;
  ArmJointLoop loop;
  loop.controller = is_fed_forward ? beside.controller : alone.controller;
  loop.reference = joint.reference;
  if (is_fed_forward) loop.fed_forward = needed;
  loop.start_position = joint.position[0];
  loop.start_velocity = (joint.reference[1] - joint.reference[0]) * joint.rate_hz;
  loop.farthest = joint.reference.maxCoeff() - joint.reference.minCoeff() +
                  (joint.position - joint.reference).cwiseAbs().maxCoeff();
  return loop;
}

Error ran_away(std::string const& recording) {
  Problem problem;
  problem.code = ExitCode::bad_data;
  problem.key = "estimator";
  problem.what = fmt::format("{}: the identified arm runs away from its reference when it is simulated", recording);
  problem.help =
      "use wls: iv needs loops that a linear controller describes, and an arm that is identified well enough to move";
  return Error(problem);
}

RecordedRows rows_of(ArmTrack const& track, InstrumentPlan const& plan, VectorXd const& parameters) {
  auto const needed = needed_torque(plant_of(plan.model, parameters), track, plan);
  std::vector<ArmJointLoop> loops;
  for (std::size_t j = 0; j < track.joints.size(); ++j)
    loops.push_back(loop_of(track.joints[j], needed.col(static_cast<Index>(j))));
  auto const& first = track.joints.front();
  auto const positions = replicate_arm(plant_of(plan.model, parameters), loops, first.rate_hz, arm_step_s);
  if (!positions) throw ran_away(first.name);
  ArmTrack replicate = track;
  for (std::size_t j = 0; j < replicate.joints.size(); ++j)
    replicate.joints[j].position = positions->col(static_cast<Index>(j));
  auto const motion = motion_of(replicate, &Recording::position, plan);
  return make_recorded_rows(first.name, motion, track.moves, plan.filter, plan.model, plan.section);
}

}  // namespace

std::function<Eigen::MatrixXd(VectorXd const&)> instruments_of(std::vector<ArmTrack> tracks, InstrumentPlan plan) {
  struct Kept {
    std::vector<ArmTrack> tracks;
    InstrumentPlan plan;
  };
  auto const kept = std::make_shared<Kept const>(Kept{std::move(tracks), std::move(plan)});
  return [kept](VectorXd const& parameters) {
    std::vector<RecordedRows> rows;
    for (auto const& track : kept->tracks) rows.push_back(rows_of(track, kept->plan, parameters));
    return stack_rows(rows, ArmRowChoice::moving, kept->plan.model, kept->plan.scale, kept->plan.section).phi;
  };
}

}  // namespace torquescope
