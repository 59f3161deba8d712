#include "engine/data/column_suggestion.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <map>

namespace torquescope {
namespace {

struct UsualName {
  std::string stem;       // before the unit, without digits
  bool is_torque = true;  // or something a motor makes torque of
};

std::map<std::string, std::vector<UsualName>> const& usual_names() {
  static std::map<std::string, std::vector<UsualName>> const names{
      {"time", {{"t"}, {"time"}, {"timestamp"}, {"stamp"}}},
      {"position", {{"q"}, {"pos"}, {"position"}, {"theta"}, {"angle"}, {"qm"}, {"x"}}},
      {"velocity", {{"qd"}, {"dq"}, {"vel"}, {"velocity"}, {"speed"}, {"omega"}}},
      {"acceleration", {{"qdd"}, {"ddq"}, {"acc"}, {"acceleration"}}},
      {"reference", {{"ref"}, {"reference"}, {"qref"}, {"q_ref"}, {"qg"}, {"q_goal"}, {"setpoint"}}},
      {"torque",
       {{"tau"},
        {"torque"},
        {"trq"},
        {"f"},
        {"force"},
        {"i", false},
        {"iq", false},
        {"current", false},
        {"u", false},
        {"v", false}}}};
  return names;
}

bool is_unit(std::string const& word) {
  static std::vector<std::string> const units{"s", "ms", "rad", "deg", "m",     "mm", "nm",
                                              "n", "a",  "ma",  "v",   "radps", "mps"};
  return std::find(units.begin(), units.end(), word) != units.end();
}

struct NameParts {
  std::string stem;  // lower case, without joint numbers
  std::string unit;  // as written
};

// "joint/q1_rad" -> "q", "rad"
NameParts parts_of(std::string const& name) {
  NameParts parts;
  std::string const last = name.substr(name.find_last_of('/') + 1);
  auto const lowered = [](std::string text) {
    std::transform(text.begin(), text.end(), text.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return text;
  };
  parts.stem = lowered(last);
  auto const break_at = last.find_last_of('_');
  if (break_at != std::string::npos && is_unit(lowered(last.substr(break_at + 1)))) {
    parts.unit = last.substr(break_at + 1);
    parts.stem = lowered(last.substr(0, break_at));
  }
  std::erase_if(parts.stem, [](unsigned char c) { return std::isdigit(c) != 0; });
  return parts;
}

}  // namespace

std::string likely_column(std::string const& channel, std::vector<std::string> const& names) {
  auto const usual = usual_names().find(channel);
  if (usual == usual_names().end()) return {};
  for (auto const& candidate : usual->second)
    for (auto const& name : names)
      if (parts_of(name).stem == candidate.stem) return name;
  return {};
}

std::string mapping_advice(std::string const& channel, std::vector<std::string> const& names) {
  auto const column = likely_column(channel, names);
  if (column.empty()) return {};
  auto const parts = parts_of(column);
  auto const& usual = usual_names().at(channel);
  bool const is_torque =
      std::any_of(usual.begin(), usual.end(), [&](auto const& n) { return n.stem == parts.stem && n.is_torque; });
  if (channel != "torque" || is_torque) return fmt::format("{} = \"{}\"", channel, column);
  return fmt::format("{} = \"{}\" with torque_per_unit = <N m per {}>", channel, column,
                     parts.unit.empty() ? "unit" : parts.unit);
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
