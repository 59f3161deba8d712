#include "engine/simulate/plant_parameters.hpp"

#include <fmt/format.h>

#include <cmath>

namespace torquescope {

namespace {

// the value of one setting; nothing, and a problem, when it is not a finite number
std::optional<double> finite_number(Section const& section, Setting const& setting, std::vector<Problem>& problems) {
  OptionValue const wanted = 0.1;
  auto const value = converted(setting.value, wanted);
  if (!value) {
    problems.push_back(wrong_type(section, setting, wanted));
    return std::nullopt;
  }
  double const number = std::get<double>(*value);
  if (std::isfinite(number)) return number;
  problems.push_back(problem_at(section, setting.key,
                                fmt::format("{} = {} is not a finite number", setting.key, number),
                                "write the parameter in SI units"));
  return std::nullopt;
}

void check_shape(Section const& section, Effect const& effect, EffectParameter const& shape, double value,
                 std::vector<Problem>& problems) {
  if (!section.find(shape.name)) {
    if (effect.has_plain_form()) return;
    problems.push_back(problem_at(
        section, shape.name, fmt::format("effect \"{}\" needs its parameter {}", effect.name(), shape.name),
        fmt::format("a recording is searched from {} to {}", bound_text(shape.lower), bound_text(shape.upper))));
  } else if (shape.spacing == Spacing::logarithmic && !(value > 0.0)) {
    problems.push_back(problem_at(section, shape.name, fmt::format("{} = {} is not above 0", shape.name, value),
                                  fmt::format("write it in {}", shape.unit_revolute)));
  }
}

// JointPlant keeps no memory and knows no torque but its own; ArmPlant does, but holds no mass behind a gap
bool can_be_in_a_plant(Effect const& effect, PlantPlace place) {
  if (effect.acts_on() != ActsOn::joint) return false;
  return place == PlantPlace::arm ? !effect.has_inertia() : !effect.has_memory() && !effect.needs_baseline();
}

}  // namespace

std::vector<PlantTerm> read_plant(Section const& section, JointKind joint, std::vector<Problem>& problems,
                                  PlantPlace place) {
  // values by effect, in the order of the registry
  std::vector<std::string> known;
  std::vector<PlantTerm> terms;
  for (Effect const* effect : effect_choices()) {
    PlantTerm term{effect, {}};
    std::string written;  // the first of its parameters that is
    for (auto const& parameter : effect->parameters()) {
      known.push_back(parameter.name);
      Setting const* setting = section.find(parameter.name);
      if (setting && written.empty()) written = parameter.name;
      term.parameters.push_back(setting ? finite_number(section, *setting, problems).value_or(0.0) : 0.0);
      if (setting && joint == JointKind::prismatic && parameter.unit_prismatic.empty())
        problems.push_back(problem_at(section, parameter.name,
                                      fmt::format("{} needs an angle, but the joint is prismatic", parameter.name),
                                      "remove it, or write joint = \"revolute\" in [model]"));
    }
    if (written.empty()) continue;
    if (!can_be_in_a_plant(*effect, place)) {
      problems.push_back(problem_at(
          section, written, fmt::format("effect \"{}\" cannot be part of the plant", effect->name()),
          place == PlantPlace::arm ? "an arm is made of effects that act on a joint and have no mass of their own; "
                                     "remove its parameters"
                                   : "a plant is made of effects that follow from position, velocity, "
                                     "acceleration and time alone; remove its parameters"));
      continue;
    }
    for (std::size_t i = 0; i < effect->parameters().size(); ++i)
      if (effect->parameters()[i].is_shape)
        check_shape(section, *effect, effect->parameters()[i], term.parameters[i], problems);
    terms.push_back(std::move(term));
  }

  for (auto const& setting : section.settings) {
    bool is_known = false;
    for (auto const& name : known) is_known = is_known || name == setting.key;
    if (!is_known) problems.push_back(unknown_key(section, setting, known));
  }
  if (section.settings.empty())
    problems.push_back(problem_at(section, "", "[simulate.plant] names no parameter of the joint",
                                  "write for example inertia = 0.01, viscous = 0.1, coulomb = 0.2"));
  return terms;
}

void check_friction_brakes(JointPlant const& plant, JointState const& rest, Section const& section,
                           std::vector<Problem>& problems) {
  HoldRange const hold = plant.hold_range(rest);
  if (hold.low > hold.high)
    problems.push_back(problem_at(
        section, section.settings.empty() ? "" : section.settings.front().key,
        fmt::format("dry friction of {:.6g} backwards and {:.6g} forwards would drive the joint", hold.low, hold.high),
        "the torque of forward motion must not be below the one of backward motion: "
        "check the signs (coulomb_negative of a real joint is negative)"));
}

void check_plant_dynamics(std::vector<PlantTerm> const& terms, double position, double step_s, Section const& section,
                          std::vector<Problem>& problems) {
  JointPlant const plant(terms);
  JointState const rest{0.0, position, 0.0, 0.0};

  double const inertia = plant.inertia(rest);
  if (!(inertia > 0.0)) {
    problems.push_back(
        problem_at(section, "inertia", fmt::format("the joint's inertia is {} (must be above 0)", inertia),
                   "write inertia = 0.01, say: a joint without inertia cannot be simulated in closed loop"));
    return;
  }

  check_friction_brakes(plant, rest, section, problems);

  // explicit integration: the fastest decay must span several steps
  JointState creeping = rest;
  creeping.dq = 1e-3;
  JointState crawling = rest;
  crawling.dq = 2e-3;
  double const damping = (plant.inverse_dynamics(crawling) - plant.inverse_dynamics(creeping)) / 1e-3;
  double const steps_per_decay = inertia / (std::abs(damping) * step_s);
  if (steps_per_decay < 4.0)
    problems.push_back(problem_at(section, "inertia",
                                  fmt::format("friction stops this joint within {:.3g} s, too fast for step_s = {}",
                                              inertia / std::abs(damping), step_s),
                                  fmt::format("write simulate.step_s = {:.2g}, or check inertia and viscous",
                                              0.1 * inertia / std::abs(damping))));
}

std::vector<TruthValue> truth_values(std::vector<PlantTerm> const& terms, JointKind joint) {
  std::vector<TruthValue> values;
  for (auto const& term : terms)
    for (std::size_t i = 0; i < term.parameters.size(); ++i) {
      auto const& parameter = term.effect->parameters()[i];
      values.push_back({parameter.name, parameter.unit_for(joint), term.parameters[i]});
    }
  return values;
}

}  // namespace torquescope
