#include "engine/robot/gather_text.hpp"

#include <fmt/format.h>

#include <cmath>
#include <vector>

namespace torquescope {

namespace {

// terms of one factor
struct Group {
  double factor;
  std::vector<std::string> names;
};

std::vector<Group> grouped(BaseParameters const& base, BaseParameter const& parameter) {
  std::vector<Group> groups;
  for (auto const& [column, factor] : parameter.gathers) {
    auto const& name = base.standard_names()[static_cast<std::size_t>(column)];
    bool found = false;
    for (auto& group : groups) {
      if (std::abs(group.factor - factor) > 1e-9 * std::abs(factor)) continue;
      group.names.push_back(name);
      found = true;
    }
    if (!found) groups.push_back({factor, {name}});
  }
  return groups;
}

}  // namespace

std::string gather_text(BaseParameters const& base, Eigen::Index parameter) {
  auto const& sum = base.parameters()[static_cast<std::size_t>(parameter)];
  std::string text = base.standard_names()[static_cast<std::size_t>(sum.column)];
  for (auto const& [factor, names] : grouped(base, sum)) {
    double const size = std::abs(factor);
    bool const is_one = std::abs(size - 1.0) < 1e-9;
    // "- (a + b)" needs its brackets as much as "0.3 (a + b)"
    bool const brackets = names.size() > 1 && !(is_one && factor > 0.0);
    text += factor < 0.0 ? " - " : " + ";
    if (!is_one) text += fmt::format("{:.4g} ", size);
    text += brackets ? fmt::format("({})", fmt::join(names, " + ")) : fmt::format("{}", fmt::join(names, " + "));
  }
  return text;
}

}  // namespace torquescope
