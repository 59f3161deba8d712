#include "engine/run/arm_keys.hpp"

#include <fmt/format.h>

#include <optional>

#include "engine/run/job_sections.hpp"

namespace torquescope {

namespace {

// of one motor; the number of its own joint is 1: the gear stands in torque_per_unit
std::optional<Problem> fault_of_drive(std::vector<double> const& turns, std::size_t joint, std::size_t joints,
                                      Section const& section) {
  std::string const help = fmt::format(
      "write one number a joint, of motor {0} per turn of it on the joint's side, and 1 for joint {0} itself", joint);
  if (turns.size() != joints)
    return problem_at(section, "motor_turns_by",
                      fmt::format("motor_turns_by has {} numbers, and the arm has {} joints", turns.size(), joints),
                      help);
  if (turns[joint - 1] != 1.0)
    return problem_at(section, "motor_turns_by",
                      fmt::format("motor {0} turns by {1:g} of its own joint {0}, not by 1", joint, turns[joint - 1]),
                      help);
  return {};
}

}  // namespace

Eigen::MatrixXd read_joint_models(Job const& job, std::size_t joints, ArmTerms& terms) {
  terms.joint_friction.assign(joints, terms.friction);
  terms.joint_sections.assign(joints, section_or_empty(job, "model"));
  std::vector<Problem> problems;
  auto const n = static_cast<Eigen::Index>(joints);
  Eigen::MatrixXd transmission = Eigen::MatrixXd::Identity(n, n);
  for (auto const& section : job.sections) {
    auto const joint = joint_of_section(section.name);
    if (!joint) continue;
    if (*joint < 1 || *joint > joints) {
      problems.push_back(problem_at(section, "", fmt::format("[{}], and the arm has {} joints", section.name, joints),
                                    "joints are numbered from 1"));
      continue;
    }
    JointModelOptions own{terms.friction};
    JointModelOptions::table().apply(section, own, problems);
    terms.joint_friction[*joint - 1] = own.friction;
    if (section.find("friction") != nullptr) terms.joint_sections[*joint - 1] = section;
    if (own.motor_turns_by.empty()) continue;
    auto fault = fault_of_drive(own.motor_turns_by, *joint, joints, section);
    if (fault)
      problems.push_back(std::move(*fault));
    else
      transmission.row(static_cast<Eigen::Index>(*joint) - 1) = Eigen::RowVectorXd::Map(own.motor_turns_by.data(), n);
  }
  if (!problems.empty()) throw Error(std::move(problems));
  return transmission.isIdentity(0.0) ? Eigen::MatrixXd() : transmission;
}

void choose_arm_effects(Experiment::Parts& parts, std::vector<Problem>& problems) {
  auto const& model = parts.arm->model;
  for (std::size_t j = 0; j < model.joints(); ++j) {
    std::vector<std::string> has;
    for (Effect const* effect : effect_choices())
      if (effect->is_rigid_body()) has.push_back(effect->name());
    if (auto const& friction = model.friction()[j])
      for (Effect const* effect : friction->terms()) has.push_back(effect->name());
    std::vector<Problem> own;
    parts.arm->effects.push_back(chosen_effects(parts.diagnose, model.chain().joints[j].kind, has,
                                                section_or_empty(parts.job, "diagnose"), own, JointsOfJob::of_an_arm));
    if (j == 0) problems.insert(problems.end(), own.begin(), own.end());
  }
  parts.effects = parts.arm->effects.front();
}

void refuse_joint_keys(Job const& job, std::vector<Problem>& problems) {
  if (Section const* model = job.find("model")) {
    for (auto const* key : {"terms", "joint"})
      if (model->find(key) != nullptr)
        problems.push_back(problem_at(*model, key, std::string("model.") + key + " beside model.robot",
                                      "the robot file says how its joints move; what each has beside the rigid arm is "
                                      "friction = [\"viscous\", \"coulomb\", \"offset\"]"));
  }
}

void refuse_beside_coupled_drives(Job const& job, std::vector<EstimatorPlan> const& plans,
                                  std::vector<Problem>& problems) {
  if (Section const* simulated = job.find("simulate"))
    problems.push_back(problem_at(*simulated, "",
                                  "[simulate] has drives of one joint each, and motor_turns_by couples some",
                                  "remove motor_turns_by, or name a recording in recording.train"));
  auto const sections = job.all("estimator");
  for (std::size_t i = 0; i < plans.size(); ++i)
    if (plans[i].needs_instruments)
      problems.push_back(
          problem_at(*sections[i], "name",
                     fmt::format("{} simulates the arm with drives of one joint each, and motor_turns_by "
                                 "couples some",
                                 plans[i].kind),
                     "use wls"));
}

void refuse_arm_keys(Job const& job, std::vector<EstimatorPlan> const& plans, std::vector<Problem>& problems) {
  auto const refuse = [&](Section const& section, std::string const& key, std::string const& what) {
    problems.push_back(problem_at(section, key, what + " is of an arm: the job has no model.robot",
                                  "name a robot file in [model], or remove it"));
  };
  for (auto const& section : job.sections)
    if (joint_of_section(section.name)) refuse(section, "", "[" + section.name + "]");
  auto const refuse_key = [&](char const* section, char const* key) {
    Section const* there = job.find(section);
    if (there != nullptr && there->find(key) != nullptr) refuse(*there, key, std::string(section) + "." + key);
  };
  for (auto const* key : {"drive_gains", "root", "tip"}) refuse_key("model", key);
  for (auto const* key : {"payload_kg", "payload_first_moments_kgm", "validate_payload_kg"})
    refuse_key("recording", key);
  auto const sections = job.all("estimator");
  for (std::size_t i = 0; i < plans.size(); ++i)
    if (plans[i].needs_instruments)
      problems.push_back(problem_at(*sections[i], "name",
                                    fmt::format("{} is for arms: the job has no model.robot", plans[i].kind),
                                    "use ols or wls, or a robot file of one joint"));
}

}  // namespace torquescope
