#include "engine/simulate/simulation_plan.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "engine/simulate/plant_parameters.hpp"

namespace torquescope {

namespace {

constexpr double most_samples = 1e8;

void check_mode(SimulationPlan const& plan, SimulationSections const& sections, std::vector<Problem>& problems) {
  if (plan.simulation.mode == "inverse_dynamics") {
    refuse_loop_sections(sections, problems);
    if (plan.noise.orthogonal_mse > 0.0 && (plan.noise.torque_std > 0.0 || plan.noise.torque_coloured_std > 0.0))
      problems.push_back(problem_at(*sections.noise, "orthogonal_mse",
                                    "orthogonal_mse and another torque noise are both given",
                                    "remove one of them: together the mean squared error would not be orthogonal_mse"));
    return;
  }
  if (plan.noise.orthogonal_mse > 0.0)
    problems.push_back(problem_at(*sections.noise, "orthogonal_mse",
                                  "orthogonal_mse has no effect in mode = \"closed_loop\"",
                                  "write torque_std, or simulate.mode = \"inverse_dynamics\""));
}

void check_encoder(SimulationPlan const& plan, Section const& encoder, std::vector<Problem>& problems) {
  if (plan.encoder.counts_per_revolution > 0.0 && plan.encoder.step > 0.0)
    problems.push_back(
        problem_at(encoder, "step", "step and counts_per_revolution are both given", "remove one of them"));
  if (plan.encoder.counts_per_revolution > 0.0 && plan.joint == JointKind::prismatic)
    problems.push_back(
        problem_at(encoder, "counts_per_revolution", "a prismatic joint has no revolutions", "write step, in metres"));
}

}  // namespace

OptionTable<SimulationOptions> const& SimulationOptions::table() {
  using O = SimulationOptions;
  static OptionTable<SimulationOptions> const options(
      "simulate", "recordings made from a known joint instead of read from a file",
      {{"mode",
        &O::mode,
        {"closed_loop", "inverse_dynamics"},
        "closed_loop: controller, encoder, stick and slip; inverse_dynamics: exact motion, torque = model + noise"},
       {"rate_hz", &O::rate_hz, "Hz", 1.0, 1e6, "samples per second of the recording"},
       {"duration_s", &O::duration_s, "s", 1e-3, 1e7, "length of the recording"},
       {"step_s", &O::step_s, "s", 1e-9, 1e-2,
        "closed_loop: longest step of the integrator; of an arm 2.5e-4 by default"},
       {"validate", &O::validate, "makes a second recording with another reference and other noise, for validation"},
       {"seed", &O::seed, "1", -1.0, 9e18, "of phases and noise; -1: the experiment's"}});
  return options;
}

std::int64_t SimulationOptions::samples() const { return std::llround(duration_s * rate_hz); }

void check_samples(SimulationOptions const& simulation, std::size_t unknowns, Section const& simulate,
                   std::vector<Problem>& problems) {
  double const samples = simulation.duration_s * simulation.rate_hz;
  if (samples < 2.0 * static_cast<double>(unknowns) + 2.0)
    problems.push_back(
        problem_at(simulate, "duration_s",
                   fmt::format("{:.3g} s at {:.6g} Hz are too few samples", simulation.duration_s, simulation.rate_hz),
                   "lengthen duration_s or raise rate_hz"));
  if (samples > most_samples)
    problems.push_back(problem_at(simulate, "duration_s", fmt::format("{:.3g} samples are too many", samples),
                                  fmt::format("stay below {:.0e} samples", most_samples)));
}

Section written_or_empty(Section const* section, Section const* simulate, std::string const& name) {
  if (section) return *section;
  return {name, simulate ? simulate->place : SourcePlace{}, {}};
}

void refuse_loop_sections(SimulationSections const& sections, std::vector<Problem>& problems) {
  // nothing is controlled or measured there: do not let anybody believe it were
  for (Section const* section : {sections.controller, sections.encoder})
    if (section) {
      Problem problem =
          problem_at(*section, "", fmt::format("[{}] has no effect in mode = \"inverse_dynamics\"", section->name),
                     "remove it, or write simulate.mode = \"closed_loop\"");
      problem.key = section->name;
      problems.push_back(std::move(problem));
    }
  for (char const* key : {"position_std", "disturbance_std"})
    if (sections.noise && sections.noise->find(key))
      problems.push_back(problem_at(*sections.noise, key,
                                    fmt::format("{} has no effect in mode = \"inverse_dynamics\"", key),
                                    "remove it: the motion is exact there"));
}

SimulationPlan read_simulation(SimulationSections const& sections, JointKind joint, std::vector<Problem>& problems) {
  Section const simulate = written_or_empty(sections.simulate, sections.simulate, "simulate");
  Section const plant = written_or_empty(sections.plant, sections.simulate, "simulate.plant");
  Section const reference = written_or_empty(sections.reference, sections.simulate, "simulate.reference");
  Section const controller = written_or_empty(sections.controller, sections.simulate, "simulate.controller");
  Section const encoder = written_or_empty(sections.encoder, sections.simulate, "simulate.encoder");
  Section const noise = written_or_empty(sections.noise, sections.simulate, "simulate.noise");

  // what was written
  SimulationPlan plan;
  plan.joint = joint;
  std::size_t const before = problems.size();
  SimulationOptions::table().apply(simulate, plan.simulation, problems);
  ReferenceOptions::table().apply(reference, plan.reference, problems);
  ControllerOptions::table().apply(controller, plan.controller, problems);
  EncoderOptions::table().apply(encoder, plan.encoder, problems);
  NoiseOptions::table().apply(noise, plan.noise, problems);
  plan.plant = read_plant(plant, joint, problems);
  for (char const* key : {"file", "validate_file"})
    if (reference.find(key))
      problems.push_back(
          problem_at(reference, key, fmt::format("{} is of an arm", key), "write a kind of motion, or model.robot"));
  check_mode(plan, sections, problems);
  if (problems.size() > before) return plan;

  // whether it fits together
  std::size_t unknowns = 0;
  for (auto const& term : plan.plant) unknowns += term.parameters.size();
  check_samples(plan.simulation, unknowns, simulate, problems);
  check_reference(plan.reference, plan.simulation.duration_s, plan.simulation.rate_hz, reference, problems);
  if (plan.simulation.mode == "closed_loop") {
    check_controller(plan.controller, plan.simulation.rate_hz, controller, problems);
    check_encoder(plan, encoder, problems);
    check_plant_dynamics(plan.plant, plan.reference.centre, plan.simulation.step_s, plant, problems);
  }
  return plan;
}

}  // namespace torquescope
