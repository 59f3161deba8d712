// Robot files in TOML, as formats/toml.cpp reads them.

#include <fmt/format.h>

#include "engine/robot/robot_writers.hpp"
#include "engine/robot/written_text.hpp"

namespace torquescope::writers {

namespace {

void put(std::string& text, char const* key, double value, double unsaid) {
  if (value != unsaid) text += fmt::format("{} = {}\n", key, number_text(value));
}

std::string joint_text(ChainJoint const& joint) {
  constexpr double none = ChainJoint::no_limit;
  std::string text = fmt::format("\n[[joint]]\nname = {}\n", quoted_text(joint.name));
  if (joint.kind == JointKind::prismatic) text += "type = \"prismatic\"\n";
  put(text, "a_m", joint.a, 0.0);
  put(text, "alpha_rad", joint.alpha, 0.0);
  put(text, "d_m", joint.d, 0.0);
  put(text, "offset_rad", joint.offset, 0.0);
  put(text, "lower", joint.lower, -none);
  put(text, "upper", joint.upper, none);
  put(text, "max_speed", joint.max_speed, none);
  put(text, "max_acceleration", joint.max_acceleration, none);
  put(text, "max_torque", joint.max_torque, none);
  put(text, "gear_ratio", joint.gear_ratio, 1.0);
  put(text, "encoder_counts", encoder_counts(joint), 0.0);
  put(text, "drive_inertia", joint.drive_inertia, 0.0);
  return text;
}

std::string write(SerialChain const& chain, std::vector<std::string> const& notes) {
  std::string text;
  for (auto const& note : notes) text += "# " + note + "\n";
  if (!chain.base.position.isZero() || !chain.base.rotation.isIdentity())
    text +=
        fmt::format("# Frame 0 stood at [{}] m in the base of the robot's own file; gravity is seen from frame 0.\n",
                    numbers_text(chain.base.position, ", "));
  text += fmt::format("{}[robot]\nname = {}\nconvention = \"modified_dh\"\ngravity = [{}]\n", text.empty() ? "" : "\n",
                      quoted_text(chain.name), numbers_text(chain.gravity, ", "));
  text += fmt::format("flange_m = [{}]\n", numbers_text(chain.flange.position, ", "));
  for (std::size_t i = 0; i < chain.joints.size(); ++i) {
    text += joint_text(chain.joints[i]);
    if (!chain.has_inertias()) continue;
    auto const body = centred_body(chain.links[i]);
    text += fmt::format("mass_kg = {}\ncentre_m = [{}]\ninertia_kgm2 = [{}]\n", number_text(body.mass),
                        numbers_text(body.centre, ", "), numbers_text(body.inertia, ", "));
  }
  return text;
}

}  // namespace

RobotWriter toml() { return {"toml", "robot file of Torquescope, modified Denavit-Hartenberg numbers", false, write}; }

}  // namespace torquescope::writers
