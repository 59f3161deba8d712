#include "engine/simulate/arm_simulation_plan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "engine/simulate/joint_sections.hpp"

namespace torquescope {

namespace {

// a table's options of every joint
template <class Options>
std::vector<Options> options_of_joints(Section const& section, std::size_t joints, std::vector<Problem>& problems) {
  std::vector<Problem> found;
  auto const each = sections_of_joints(section, joints, list_keys(Options::table().describe()), found);
  std::vector<Options> options(joints);
  for (std::size_t j = 0; j < joints; ++j) Options::table().apply(each[j], options[j], found);
  append_new(found, problems);
  return options;
}

void add_terms(std::vector<PlantTerm> const& terms, ArmJointTerms& joint) {
  for (auto const& term : terms) (term.effect->has_memory() ? joint.remembering : joint.instant).push_back(term);
}

// of the list of [[simulate.effects]]: the joint's number, or nothing and a problem
std::size_t joint_of(Section const& section, std::size_t joints, std::vector<Problem>& problems) {
  Setting const* setting = section.find("joint");
  OptionValue const wanted = std::int64_t{1};
  auto const value = setting ? converted(setting->value, wanted) : std::nullopt;
  std::int64_t const number = value ? std::get<std::int64_t>(*value) : 0;
  if (number >= 1 && number <= static_cast<std::int64_t>(joints)) return static_cast<std::size_t>(number - 1);
  problems.push_back(problem_at(section, "joint", "[[simulate.effects]] does not say at which joint",
                                fmt::format("write joint = 1, or up to joint = {}", joints)));
  return joints;
}

void read_effect(Section const& section, SerialChain const& chain, std::vector<ArmJointTerms>& terms,
                 std::vector<Problem>& problems) {
  std::size_t const joint = joint_of(section, chain.joints.size(), problems);
  Setting const* setting = section.find("name");
  auto const* name = setting ? std::get_if<std::string>(&setting->value) : nullptr;
  Effect const* effect = name ? find_effect(*name) : nullptr;
  if (effect != nullptr && effect->is_given()) {
    problems.push_back(problem_at(section, "name", fmt::format("\"{}\" cannot be simulated at one joint", *name),
                                  "remove it: it acts on several joints, which a diagnosis looks for"));
    return;
  }
  if (effect == nullptr) {
    std::vector<std::string> known;
    for (Effect const* one : effect_choices()) known.push_back(one->name());
    std::string const close = name ? closest_name(*name, known) : "";
    problems.push_back(problem_at(
        section, "name",
        name ? fmt::format("no effect is called \"{}\"", *name) : "[[simulate.effects]] does not say which effect",
        close.empty() ? "torquescope list effects" : fmt::format("did you mean name = \"{}\"?", close)));
    return;
  }
  if (joint == chain.joints.size()) return;
  Section parameters{section.name, section.place, {}};
  for (auto const& one : section.settings)
    if (one.key != "joint" && one.key != "name") parameters.settings.push_back(one);
  auto const read = read_plant(parameters, chain.joints[joint].kind, problems, PlantPlace::arm);
  for (auto const& term : read)
    if (term.effect != effect)
      problems.push_back(problem_at(
          section, "name",
          fmt::format("a parameter of \"{}\" stands beside name = \"{}\"", term.effect->name(), effect->name()),
          "write another [[simulate.effects]] for it"));
  add_terms(read, terms[joint]);
}

std::vector<ArmJointTerms> read_terms(ArmSimulationSections const& sections, SerialChain const& chain,
                                      std::vector<Problem>& problems) {
  std::vector<ArmJointTerms> terms(chain.joints.size());
  if (Section const* plant = sections.simulate.plant; plant && !plant->settings.empty()) {
    std::vector<Problem> found;
    auto const each = sections_of_joints(
        *plant, terms.size(), [](auto const&) { return false; }, found);
    for (std::size_t j = 0; j < terms.size(); ++j)
      add_terms(read_plant(each[j], chain.joints[j].kind, found, PlantPlace::arm), terms[j]);
    append_new(found, problems);
  }
  for (Section const* effect : sections.effects) read_effect(*effect, chain, terms, problems);
  return terms;
}

// what the robot file knows, where the job does not say it
void apply_limits(ChainJoint const& joint, SimulationSections const& sections, ArmJointPlan& plan) {
  auto const is_written = [](Section const* section, char const* key) { return section && section->find(key); };
  bool const has_range = std::isfinite(joint.lower) && std::isfinite(joint.upper);
  double const middle = has_range ? 0.5 * (joint.lower + joint.upper) : 0.0;
  auto& reference = plan.reference;
  if (!is_written(sections.reference, "centre")) reference.centre = middle;
  if (!is_written(sections.reference, "amplitude") && has_range)
    reference.amplitude = std::min(reference.centre - joint.lower, joint.upper - reference.centre);
  if (!is_written(sections.reference, "max_speed") && std::isfinite(joint.max_speed))
    reference.max_speed = joint.max_speed;
  if (!is_written(sections.reference, "max_acceleration") && std::isfinite(joint.max_acceleration))
    reference.max_acceleration = joint.max_acceleration;
  if (sections.encoder == nullptr) plan.encoder.step = joint.encoder_step;
  if (!is_written(sections.controller, "torque_limit") && std::isfinite(joint.max_torque))
    plan.controller.torque_limit = joint.max_torque;
}

void check_arm(ArmSimulationPlan const& plan, SimulationSections const& sections, std::vector<Problem>& problems) {
  Section const simulate = written_or_empty(sections.simulate, sections.simulate, "simulate");
  Section const reference = written_or_empty(sections.reference, sections.simulate, "simulate.reference");
  Section const controller = written_or_empty(sections.controller, sections.simulate, "simulate.controller");
  Section const plant = written_or_empty(sections.plant, sections.simulate, "simulate.plant");
  std::vector<Problem> found;
  if (plan.simulation.mode == "inverse_dynamics") refuse_loop_sections(sections, found);
  auto const& moved = plan.joints.front().reference;
  if (moved.file.empty() && !moved.validate_file.empty())
    found.push_back(problem_at(reference, "validate_file", "validate_file stands without file",
                               "write file = the motion to learn from as well"));
  check_samples(plan.simulation, 11 * plan.joints.size(), simulate, found);
  for (auto const& joint : plan.joints) {
    if (moved.file.empty())
      check_reference(joint.reference, plan.simulation.duration_s, plan.simulation.rate_hz, reference, found);
    if (plan.simulation.mode == "closed_loop")
      check_controller(joint.controller, plan.simulation.rate_hz, controller, found);
    check_friction_brakes(JointPlant(joint.terms.instant), {0.0, joint.reference.centre, 0.0, 0.0}, plant, found);
    if (joint.controller.rate_hz != plan.joints.front().controller.rate_hz)
      found.push_back(
          problem_at(controller, "rate_hz", "controllers of one arm tick at one rate", "write one number for rate_hz"));
    if (joint.noise.orthogonal_mse > 0.0)
      found.push_back(
          problem_at(*sections.noise, "orthogonal_mse", "orthogonal_mse is of a single joint", "write torque_std"));
  }
  append_new(found, problems);
}

}  // namespace

ArmSimulationPlan read_arm_simulation(ArmSimulationSections const& sections, SerialChain const& chain,
                                      std::vector<Problem>& problems) {
  auto const& written = sections.simulate;
  auto const section = [&](Section const* one, char const* name) {
    return written_or_empty(one, written.simulate, name);
  };
  std::size_t const n = chain.joints.size(), before = problems.size();
  ArmSimulationPlan plan;
  plan.chain = chain;
  Section const simulate = section(written.simulate, "simulate");
  if (!chain.has_inertias())
    problems.push_back(problem_at(simulate, "", fmt::format("robot \"{}\" has no masses: it cannot move", chain.name),
                                  "write mass_kg, centre_m and inertia_kgm2 of its joints in the robot file"));
  SimulationOptions::table().apply(simulate, plan.simulation, problems);
  if (!simulate.find("step_s")) plan.simulation.step_s = arm_step_s;
  auto const references =
      options_of_joints<ReferenceOptions>(section(written.reference, "simulate.reference"), n, problems);
  auto const controllers =
      options_of_joints<ControllerOptions>(section(written.controller, "simulate.controller"), n, problems);
  auto const encoders = options_of_joints<EncoderOptions>(section(written.encoder, "simulate.encoder"), n, problems);
  auto const noises = options_of_joints<NoiseOptions>(section(written.noise, "simulate.noise"), n, problems);
  auto const terms = read_terms(sections, chain, problems);
  if (problems.size() > before) return plan;

  for (std::size_t j = 0; j < n; ++j) {
    plan.joints.push_back({terms[j], references[j], controllers[j], encoders[j], noises[j]});
    apply_limits(chain.joints[j], written, plan.joints[j]);
  }
  check_arm(plan, written, problems);
  return plan;
}

}  // namespace torquescope
