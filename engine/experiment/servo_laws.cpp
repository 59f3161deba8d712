#include "engine/experiment/servo_laws.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "engine/effects/effect.hpp"
#include "engine/infer/all_rows/loop_moves.hpp"

namespace torquescope {
namespace {

DriveLaw const* drive_law_named(std::string const& name) {
  for (DriveLaw const* law : drive_laws())
    if (name == law->name) return law;
  return nullptr;
}

std::vector<std::string> names_of_laws(Regressor const& regressor) {
  std::vector<std::string> names;
  for (DriveLaw const* law : drive_laws()) names.emplace_back(law->name);
  for (Effect const* effect : effect_choices())
    if (can_be_simulated(*effect, regressor)) names.push_back(effect->name());
  return names;
}

Problem unknown_law(std::string const& name, Regressor const& regressor, Section const& section) {
  bool const is_effect = find_effect(name) != nullptr;
  std::string const what =
      is_effect ? fmt::format("effect \"{}\" is in the model already, or no simulation of a servo can hold it", name)
                : fmt::format("unknown effect \"{}\"", name);
  Problem problem = problem_at(section, "effects", what,
                               "effects = \"all\" asks for every effect of drive and gear (torquescope list laws)");
  std::string const close = is_effect ? std::string() : closest_name(name, names_of_laws(regressor));
  if (!close.empty()) problem.caret_note = fmt::format("did you mean \"{}\"?", close);
  return problem;
}

}  // namespace

ServoLaws servo_laws(DiagnoseOptions const& options, Regressor const& regressor, Section const& section,
                     std::vector<Problem>& problems) {
  ServoLaws laws;
  if (options.effects == std::vector<std::string>{"all"}) {
    laws.of_drive.assign(drive_laws().begin(), drive_laws().end());
    return laws;
  }
  for (auto const& name : options.effects) {
    DriveLaw const* of_drive = drive_law_named(name);
    Effect const* effect = of_drive != nullptr ? nullptr : find_effect(name);
    bool const is_told = std::count(options.effects.begin(), options.effects.end(), name) > 1;
    if (is_told)
      problems.push_back(
          problem_at(section, "effects", fmt::format("effect \"{}\" stands twice", name), "remove one of them"));
    else if (of_drive != nullptr)
      laws.of_drive.push_back(of_drive);
    else if (effect != nullptr && can_be_simulated(*effect, regressor))
      laws.of_joint.push_back(effect);
    else
      problems.push_back(unknown_law(name, regressor, section));
  }
  return laws;
}

}  // namespace torquescope
