#include "engine/run/arm_keys.hpp"

#include <fmt/format.h>

#include "engine/run/job_sections.hpp"

namespace torquescope {

void read_joint_friction(Job const& job, std::size_t joints, ArmTerms& terms) {
  terms.joint_friction.assign(joints, terms.friction);
  terms.joint_sections.assign(joints, section_or_empty(job, "model"));
  std::vector<Problem> problems;
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
  }
  if (!problems.empty()) throw Error(std::move(problems));
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
