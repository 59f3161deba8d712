#include "engine/robot/written_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numbers>

namespace torquescope {

std::string number_text(double value) { return fmt::format("{}", value == 0.0 ? 0.0 : value); }

std::string numbers_text(Eigen::Ref<Eigen::VectorXd const> const& values, char const* between) {
  std::string text;
  for (Eigen::Index k = 0; k < values.size(); ++k) text += (k == 0 ? "" : between) + number_text(values[k]);
  return text;
}

std::string xml_text(std::string const& text) {
  std::string safe;
  for (char const c : text) {
    if (c == '&') {
      safe += "&amp;";
    } else if (c == '<') {
      safe += "&lt;";
    } else if (c == '>') {
      safe += "&gt;";
    } else if (c == '"') {
      safe += "&quot;";
    } else {
      safe += c;
    }
  }
  return safe;
}

std::string xml_comment(std::string const& text) {
  std::string safe;
  for (char const c : text) safe += c == '-' && safe.ends_with('-') ? " -" : std::string(1, c);
  return fmt::format("<!-- {} -->\n", safe);
}

std::string quoted_text(std::string const& text) {
  std::string safe = "\"";
  for (char const c : text) {
    if (c == '"' || c == '\\') safe += '\\';
    bool const is_control = static_cast<unsigned char>(c) < 0x20;
    safe += is_control ? fmt::format("\\u{:04x}", static_cast<unsigned>(c)) : std::string(1, c);
  }
  return safe + '"';
}

CentredBody centred_body(LinkInertia const& link) {
  Eigen::Matrix3d const about = link.about_centre();
  CentredBody body{link.mass, link.first_moment / link.mass, {}};
  body.inertia << about(0, 0), about(0, 1), about(0, 2), about(1, 1), about(1, 2), about(2, 2);
  return body;
}

std::string lost_numbers(ChainJoint const& joint, std::span<std::string_view const> keys) {
  struct Number {
    std::string_view key;
    double value, unknown;
  };
  constexpr double none = ChainJoint::no_limit;
  std::string list;
  for (auto const& [key, value, unknown] : {Number{"gear_ratio", joint.gear_ratio, 1.0},
                                            {"drive_inertia", joint.drive_inertia, 0.0},
                                            {"encoder_counts", encoder_counts(joint), 0.0},
                                            {"max_speed", joint.max_speed, none},
                                            {"max_acceleration", joint.max_acceleration, none},
                                            {"max_torque", joint.max_torque, none}})
    if (value != unknown && std::find(keys.begin(), keys.end(), key) != keys.end())
      list += fmt::format("{}{} = {}", list.empty() ? "" : ", ", key, number_text(value));
  return list.empty() ? "" : xml_comment(fmt::format("joint {}: {}", quoted_text(joint.name), list));
}

double encoder_counts(ChainJoint const& joint) {
  if (joint.encoder_step <= 0.0) return 0.0;
  return joint.kind == JointKind::revolute ? 2.0 * std::numbers::pi / (joint.encoder_step * joint.gear_ratio)
                                           : 1.0 / joint.encoder_step;
}

}  // namespace torquescope
