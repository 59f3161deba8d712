#include "engine/account/job_lines.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "engine/effects/beside_arm.hpp"

namespace torquescope {

std::vector<std::vector<std::string>> job_lines(JointDiagnosis const& joint) {
  std::vector<std::vector<std::string>> all;
  JointKind const kind = joint.unit_position == "m" ? JointKind::prismatic : JointKind::revolute;
  for (auto const& named : joint.effects) {
    Effect const* const effect = find_effect(named.name);
    if (effect == nullptr || !why_not_beside_arm(*effect, kind).empty()) continue;
    std::vector<std::string> lines{"[[model.effects]]", fmt::format("joint = {}", joint.joint),
                                   fmt::format("name = \"{}\"", named.name)},
        shapes;
    for (auto const& parameter : effect->parameters())
      for (auto const& found : named.parameters)
        if (parameter.is_shape && found.name == parameter.name)
          shapes.push_back(fmt::format("{} = {:.4g}", found.name, found.value));
    if (shapes.size() == effect->n_shape()) lines.insert(lines.end(), shapes.begin(), shapes.end());
    all.push_back(std::move(lines));
  }
  return all;
}

}  // namespace torquescope
