#include "engine/data/health/joined_findings.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "engine/data/health/finding_text.hpp"

namespace torquescope {
namespace {

bool are_alike(Finding const& a, Finding const& b) {
  return !a.joint.empty() && !b.joint.empty() && a.kind == b.kind && a.grade == b.grade && a.repair == b.repair &&
         a.recording == b.recording && cure_of(a) == cure_of(b);
}

bool is_less(Finding const& a, Finding const& b) {
  return std::tuple(a.count, std::abs(a.size)) < std::tuple(b.count, std::abs(b.size));
}

Finding joined(std::vector<Finding> const& alike) {
  auto const most = std::max_element(alike.begin(), alike.end(), is_less);
  Finding one = *most;
  for (auto it = alike.begin(); it != alike.end(); ++it)
    if (it != most && it->joint != one.joint) one.likewise.push_back(it->joint);
  return one;
}

}  // namespace

std::vector<Finding> joined_findings(std::vector<Finding> const& findings) {
  std::vector<std::vector<Finding>> groups;
  for (auto const& finding : findings) {
    auto const group = std::find_if(groups.begin(), groups.end(),
                                    [&](auto const& others) { return are_alike(others.front(), finding); });
    if (group == groups.end())
      groups.push_back({finding});
    else
      group->push_back(finding);
  }
  std::vector<Finding> all;
  for (auto const& group : groups) all.push_back(joined(group));
  return all;
}

}  // namespace torquescope
