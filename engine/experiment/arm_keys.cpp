#include "engine/experiment/arm_keys.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "engine/effects/beside_arm.hpp"
#include "engine/experiment/job_sections.hpp"

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

namespace {

std::optional<double> number_in(Setting const& setting) {
  auto const value = converted(setting.value, 0.0);
  return value ? std::optional(std::get<double>(*value)) : std::nullopt;
}

Effect const* effect_of_section(Section const& section, JointKind kind, std::vector<Problem>& problems) {
  Setting const* const name = section.find("name");
  auto const* const word = name ? std::get_if<std::string>(&name->value) : nullptr;
  Effect const* const effect = word ? find_effect(*word) : nullptr;
  std::string const why = effect ? why_not_beside_arm(*effect, kind) : "";
  if (effect != nullptr && why.empty()) return effect;
  std::string what = "an effect of [[model.effects]] has no name";
  if (word) what = fmt::format("\"{}\" is no effect of a joint", *word);
  if (!why.empty()) what = fmt::format("\"{}\" cannot stand beside an arm: {}", *word, why);
  problems.push_back(problem_at(section, "name", what, "torquescope list effects"));
  return nullptr;
}

std::optional<std::size_t> joint_of_effect(Section const& section, std::size_t joints, std::vector<Problem>& problems) {
  Setting const* const setting = section.find("joint");
  auto const number = setting ? number_in(*setting) : std::nullopt;
  for (std::size_t j = 0; number && j < joints; ++j)
    if (*number == static_cast<double>(j + 1)) return j;
  problems.push_back(problem_at(section, "joint", "an effect of an arm stands at one of its joints",
                                fmt::format("write joint = 1 to joint = {}", joints)));
  return {};
}

// where the search of its shapes begins; none of them: anywhere
std::vector<double> shape_of_effect(Section const& section, Effect const& effect, std::vector<Problem>& problems) {
  std::vector<std::string> known{"name", "joint"};
  std::vector<double> shape;
  for (std::size_t k = effect.n_linear(); k < effect.parameters().size(); ++k) {
    known.push_back(effect.parameters()[k].name);
    Setting const* const setting = section.find(known.back());
    if (setting == nullptr) continue;
    if (auto const value = number_in(*setting))
      shape.push_back(*value);
    else
      problems.push_back(wrong_type(section, *setting, 0.0));
  }
  for (auto const& setting : section.settings)
    if (std::find(known.begin(), known.end(), setting.key) == known.end())
      problems.push_back(unknown_key(section, setting, known));
  if (!shape.empty() && shape.size() != effect.n_shape())
    problems.push_back(problem_at(section, "name", fmt::format("{} has some of its shapes, not all", effect.name()),
                                  "give all of them or none: what is given is where the search begins"));
  return shape;
}

}  // namespace

std::vector<HeldEffect> read_arm_effects(Job const& job, SerialChain const& chain) {
  std::vector<Problem> problems;
  std::vector<HeldEffect> effects;
  for (Section const* section : job.all("model.effects")) {
    auto const joint = joint_of_effect(*section, chain.joints.size(), problems);
    if (!joint) continue;
    Effect const* effect = effect_of_section(*section, chain.joints[*joint].kind, problems);
    if (effect == nullptr) continue;
    bool const is_there = std::any_of(effects.begin(), effects.end(), [&](HeldEffect const& other) {
      return other.effect == effect && other.joint == *joint;
    });
    if (is_there)
      problems.push_back(problem_at(*section, "name",
                                    fmt::format("{} of joint {} stands there twice", effect->name(), *joint + 1),
                                    "remove one"));
    effects.push_back({effect, *joint, shape_of_effect(*section, *effect, problems)});
  }
  if (!problems.empty()) throw Error(std::move(problems));
  return effects;
}

void choose_arm_effects(Experiment::Parts& parts, std::vector<Problem>& problems) {
  auto const& model = parts.arm->model;
  for (std::size_t j = 0; j < model.joints(); ++j) {
    std::vector<std::string> has;
    for (Effect const* effect : effect_choices())
      if (effect->is_rigid_body()) has.push_back(effect->name());
    if (auto const& friction = model.friction()[j])
      for (Effect const* effect : friction->terms()) has.push_back(effect->name());
    for (HeldEffect const& held : model.effects())
      if (held.joint == j) has.push_back(held.effect->name());
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

void refuse_beside_effects(Job const& job, std::vector<EstimatorPlan> const& plans, std::vector<Problem>& problems) {
  auto const sections = job.all("estimator");
  for (std::size_t i = 0; i < plans.size(); ++i)
    if (plans[i].needs_instruments)
      problems.push_back(problem_at(
          *sections[i], "name",
          fmt::format("{} simulates the arm without the effects of [[model.effects]]", plans[i].kind), "use wls"));
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

void refuse_motor_torques(Job const& job, RecordingOptions const& options, SerialChain const& chain,
                          std::vector<Problem>& problems) {
  if (options.torque_at == "joints" || chain.has_coupled_drives()) return;
  problems.push_back(problem_at(section_or_empty(job, "recording"), "torque_at",
                                "torque_at = \"motors\", and no motor turns with another joint than its own",
                                "say which one does: motor_turns_by in [model.joint_3]; gears are torque_per_unit"));
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
  for (auto const* key : {"payload_kg", "payload_first_moments_kgm", "validate_payload_kg", "wrench", "wrench_frame",
                          "wrench_on", "torque_at"})
    refuse_key("recording", key);
  auto const sections = job.all("estimator");
  for (std::size_t i = 0; i < plans.size(); ++i)
    if (plans[i].needs_instruments)
      problems.push_back(problem_at(*sections[i], "name",
                                    fmt::format("{} is for arms: the job has no model.robot", plans[i].kind),
                                    "use ols or wls, or a robot file of one joint"));
}

}  // namespace torquescope
