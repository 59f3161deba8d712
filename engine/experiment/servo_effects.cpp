#include "engine/experiment/servo_effects.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "engine/effects/effect.hpp"
#include "engine/infer/decision/loop_moves.hpp"

namespace torquescope {
namespace {

DriveEffect const* drive_effect_named(std::string const& name) {
  for (DriveEffect const* effect : drive_effects())
    if (name == effect->name) return effect;
  return nullptr;
}

std::vector<std::string> names_of_effects(Regressor const& regressor) {
  std::vector<std::string> names;
  for (DriveEffect const* effect : drive_effects()) names.emplace_back(effect->name);
  for (Effect const* effect : effect_choices())
    if (can_be_simulated(*effect, regressor)) names.push_back(effect->name());
  return names;
}

Problem unknown_effect(std::string const& name, Regressor const& regressor, Section const& section) {
  bool const is_effect = find_effect(name) != nullptr;
  std::string const what =
      is_effect ? fmt::format("effect \"{}\" is in the model already, or no simulation of a servo can hold it", name)
                : fmt::format("unknown effect \"{}\"", name);
  Problem problem = problem_at(section, "effects", what,
                               "effects = \"all\" asks for every effect of drive and gear (torquescope list laws)");
  std::string const close = is_effect ? std::string() : closest_name(name, names_of_effects(regressor));
  if (!close.empty()) problem.caret_note = fmt::format("did you mean \"{}\"?", close);
  return problem;
}

}  // namespace

ServoEffects servo_effects(DiagnoseOptions const& options, Regressor const& regressor, Section const& section,
                           std::vector<Problem>& problems) {
  ServoEffects effects;
  if (options.effects == std::vector<std::string>{"all"}) {
    effects.of_drive.assign(drive_effects().begin(), drive_effects().end());
    return effects;
  }
  for (auto const& name : options.effects) {
    DriveEffect const* of_drive = drive_effect_named(name);
    Effect const* effect = of_drive != nullptr ? nullptr : find_effect(name);
    bool const is_told = std::count(options.effects.begin(), options.effects.end(), name) > 1;
    if (is_told)
      problems.push_back(
          problem_at(section, "effects", fmt::format("effect \"{}\" stands twice", name), "remove one of them"));
    else if (of_drive != nullptr)
      effects.of_drive.push_back(of_drive);
    else if (effect != nullptr && can_be_simulated(*effect, regressor))
      effects.of_joint.push_back(effect);
    else
      problems.push_back(unknown_effect(name, regressor, section));
  }
  return effects;
}

}  // namespace torquescope
