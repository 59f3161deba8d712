#include "engine/data/health/channel_units.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <optional>
#include <regex>

#include "engine/data/unit_of_name.hpp"

namespace torquescope {
namespace {

std::optional<NamedUnit> unit_of(Examination const& exam, std::string const& channel) {
  if (!exam.has(channel)) return {};
  auto const& column = exam.channels.at(channel).column;
  auto const& names = exam.table.names;
  auto const at = static_cast<std::size_t>(std::find(names.begin(), names.end(), column) - names.begin());
  return unit_of_name(column, at < exam.table.units.size() ? exam.table.units[at] : std::string());
}

void examine_position_unit(Examination& exam) {
  constexpr double fewest_counts = 50;
  if (exam.writes("position_per_unit")) return;
  auto const unit = unit_of(exam, "position");
  if (unit && unit->quantity == Quantity::counts)
    exam.add(FindingKind::position_in_counts, Grade::fault, Repair::none, "position", {});
  else if (unit && (unit->quantity == Quantity::angle || unit->quantity == Quantity::length) && unit->si != 1.0)
    exam.add(FindingKind::unit_in_name, Grade::fault, Repair::none, "position", {}, unit->si, unit->word);
  else if (!unit && are_whole_numbers(exam.values("position")) && range_of(exam.values("position")) >= fewest_counts)
    exam.add(FindingKind::position_in_counts, Grade::fault, Repair::none, "position", {});
}

void examine_torque_unit(Examination& exam) {
  if (exam.writes("torque_per_unit")) return;
  auto const unit = unit_of(exam, "torque");
  if (!unit) return;
  using enum Quantity;
  if (unit->quantity == ratio || unit->quantity == counts)
    exam.add(FindingKind::unit_of_current, Grade::fault, Repair::none, "torque", {}, 0.0, unit->word);
  else if ((unit->quantity == torque || unit->quantity == force) && unit->si != 1.0)
    exam.add(FindingKind::unit_in_name, Grade::fault, Repair::none, "torque", {}, unit->si, unit->word);
  else if (unit->quantity == current || unit->quantity == voltage)
    exam.add(FindingKind::unit_of_current, Grade::warning, Repair::none, "torque", {}, 0.0, unit->word);
}

std::string lowered(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

bool is_called_command(std::string const& column) {
  static std::regex const words(
      "^r([_0-9 ]|$)|(^|[^a-z])(ref|cmd|command|goal|target|setpoint|des|desired|soll|demand)");
  return std::regex_search(lowered(column), words);
}

void examine_command(Examination& exam) {
  std::string const& column = exam.channels.at("position").column;
  if (!is_called_command(column)) return;
  std::string measured;
  for (auto const& name : exam.table.names)
    if (name != column && !is_called_command(name) && unit_of_name(name) &&
        unit_of_name(name)->quantity == Quantity::angle)
      measured = name;
  exam.add(FindingKind::command_as_position, Grade::warning, Repair::none, "position", {}, 0.0, measured);
}

// "q3_rad" -> "q", "_rad": a name with one number in it
std::optional<std::pair<std::string, std::string>> around_number(std::string const& name) {
  auto const is_digit = [](unsigned char c) { return std::isdigit(c) != 0; };
  auto const first = std::find_if(name.begin(), name.end(), is_digit);
  if (first == name.end()) return {};
  auto const end = std::find_if_not(first, name.end(), is_digit);
  return std::pair(std::string(name.begin(), first), std::string(end, name.end()));
}

}  // namespace

std::string unit_of_unknown_torque(Examination const& exam) {
  bool const is_known = exam.writes("torque_per_unit") && std::abs(exam.options.torque_factor()) != 1.0;
  auto const unit = unit_of(exam, "torque");
  if (is_known || !unit) return {};
  using enum Quantity;
  bool const is_other =
      unit->quantity == ratio || unit->quantity == counts || unit->quantity == current || unit->quantity == voltage;
  return is_other ? unit->word : "";
}

void examine_units(Examination& exam) {
  examine_position_unit(exam);
  examine_torque_unit(exam);
  examine_command(exam);
}

std::vector<std::size_t> other_joint_columns(Examination& exam) {
  constexpr double moves = 0.02;  // of the range of the joint that was asked for
  std::string const& column = exam.channels.at("position").column;
  auto const own = around_number(column);
  if (!own) return {};
  double const range = range_of(exam.values("position"));
  std::vector<std::size_t> others;
  for (std::size_t c = 0; c < exam.table.names.size(); ++c) {
    auto const& name = exam.table.names[c];
    if (name == column || around_number(name) != own) continue;
    if (range_of(exam.table.columns[c]) > moves * range) others.push_back(c);
  }
  return others;
}

void find_other_joints(Examination& exam) {
  auto const found = other_joint_columns(exam);
  if (found.empty()) return;
  std::string others;
  for (std::size_t c : found) others += (others.empty() ? "" : ", ") + exam.table.names[c];
  exam.add(FindingKind::other_joints_move, Grade::note, Repair::none, "position", {}, 0.0, others).count =
      static_cast<std::int64_t>(found.size());
}

}  // namespace torquescope
