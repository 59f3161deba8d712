#include "engine/data/column_suggestion.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace torquescope {
namespace {

bool serves(std::string const& channel, ColumnRole const& role) {
  if (channel == "time") return role.quantity == WordKind::time;
  if (channel == "position") return role.quantity == WordKind::position && !role.commanded;
  if (channel == "reference") return role.quantity == WordKind::position && role.commanded;
  if (channel == "velocity") return role.quantity == WordKind::velocity && !role.commanded;
  if (channel == "acceleration") return role.quantity == WordKind::acceleration && !role.commanded;
  return channel == "torque" && (role.quantity == WordKind::torque || role.quantity == WordKind::drive);
}

}  // namespace

std::vector<LikelyColumn> likely_columns(std::string const& channel, std::vector<std::string> const& names,
                                         std::vector<std::string> const& units) {
  constexpr int a_command_is_no_torque = 50;  // what a drive was asked for: only where nothing was measured
  std::vector<LikelyColumn> likely;
  for (std::size_t k = 0; k < names.size(); ++k) {
    auto const& column = names[k];
    auto const name = parse_column_name(column, k < units.size() ? units[k] : "");
    auto role = column_role(name);
    if (!serves(channel, role)) continue;
    if (channel == "torque" && role.commanded) role.score -= a_command_is_no_torque;
    if (role.score > 0) likely.push_back({column, name, role});
  }
  std::stable_sort(likely.begin(), likely.end(),
                   [](LikelyColumn const& a, LikelyColumn const& b) { return a.role.score > b.role.score; });
  return likely;
}

std::string likely_column(std::string const& channel, std::vector<std::string> const& names) {
  auto const likely = likely_columns(channel, names);
  return likely.empty() ? "" : likely.front().column;
}

std::string mapping_advice(std::string const& channel, std::vector<std::string> const& names) {
  auto const likely = likely_columns(channel, names);
  if (likely.empty()) return {};
  auto const& best = likely.front();
  if (best.role.quantity != WordKind::drive) return fmt::format("{} = \"{}\"", channel, best.column);
  return fmt::format("{} = \"{}\" with torque_per_unit = <N m per {}>", channel, best.column,
                     best.name.unit_text.empty() ? "unit" : best.name.unit_text);
}

std::string columns_advice(std::vector<std::string> const& names) {
  auto const column = [&](char const* channel) {
    auto const likely = likely_column(channel, names);
    return likely.empty() ? std::string("<column>") : likely;
  };
  return fmt::format("columns = {{time = \"{}\", position = \"{}\", torque = \"{}\"}}", column("time"),
                     column("position"), column("torque"));
}

}  // namespace torquescope
