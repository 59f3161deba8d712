// Robots in JSON: what a TOML robot says, with the parameters about the link frames as well, for other programs.

#include <fmt/format.h>

#include <utility>

#include "engine/robot/robot_writers.hpp"
#include "engine/robot/written_text.hpp"

namespace torquescope::writers {

namespace {

// what is not limited is left out: JSON has no infinity
std::string joint_text(ChainJoint const& joint) {
  std::string text = fmt::format("      \"name\": {},\n      \"type\": \"{}\"", quoted_text(joint.name),
                                 joint.kind == JointKind::revolute ? "revolute" : "prismatic");
  for (auto const& [key, value] : {std::pair{"a_m", joint.a},
                                   {"alpha_rad", joint.alpha},
                                   {"d_m", joint.d},
                                   {"offset_rad", joint.offset},
                                   {"lower", joint.lower},
                                   {"upper", joint.upper},
                                   {"max_speed", joint.max_speed},
                                   {"max_acceleration", joint.max_acceleration},
                                   {"max_torque", joint.max_torque},
                                   {"gear_ratio", joint.gear_ratio},
                                   {"encoder_counts", encoder_counts(joint)},
                                   {"drive_inertia", joint.drive_inertia}})
    if (std::isfinite(value)) text += fmt::format(",\n      \"{}\": {}", key, number_text(value));
  return text;
}

std::string link_text(LinkInertia const& link) {
  auto const body = centred_body(link);
  std::string text =
      fmt::format(",\n      \"mass_kg\": {},\n      \"centre_m\": [{}],\n      \"inertia_kgm2\": [{}]",
                  number_text(body.mass), numbers_text(body.centre, ", "), numbers_text(body.inertia, ", "));
  LinkVector const numbers = link.vector();
  text += ",\n      \"about_frame\": {";
  for (std::size_t k = 0; k < link_number_names.size(); ++k)
    text += fmt::format("{}\"{}\": {}", k == 0 ? "" : ", ", link_number_names[k],
                        number_text(numbers[static_cast<Eigen::Index>(k)]));
  return text + "}";
}

std::string write(SerialChain const& chain, std::vector<std::string> const& notes) {
  std::string text =
      fmt::format("{{\n  \"name\": {},\n  \"convention\": \"modified_dh\",\n  \"notes\": [", quoted_text(chain.name));
  for (std::size_t k = 0; k < notes.size(); ++k)
    text += fmt::format("{}\n    {}", k == 0 ? "" : ",", quoted_text(notes[k]));
  text += fmt::format("{}],\n  \"gravity\": [{}],\n", notes.empty() ? "" : "\n  ", numbers_text(chain.gravity, ", "));
  text += fmt::format("  \"base_m\": [{}],\n  \"flange_m\": [{}],\n  \"joints\": [",
                      numbers_text(chain.base.position, ", "), numbers_text(chain.flange.position, ", "));
  for (std::size_t i = 0; i < chain.joints.size(); ++i)
    text += fmt::format("{}\n    {{\n{}{}\n    }}", i == 0 ? "" : ",", joint_text(chain.joints[i]),
                        chain.has_inertias() ? link_text(chain.links[i]) : "");
  return text + "\n  ]\n}\n";
}

}  // namespace

RobotWriter json() { return {"json", "the same numbers for other programs", false, write}; }

}  // namespace torquescope::writers
