#include "engine/data/column_guess.hpp"

#include <algorithm>
#include <cmath>
#include <functional>

#include "engine/data/columns.hpp"

namespace torquescope {
namespace {

using Label = std::function<std::string(ColumnName const&)>;

bool whole_numbers(std::vector<double> const& values) {
  return std::all_of(values.begin(), values.end(), [](double v) { return std::isnan(v) || v == std::round(v); });
}

// whole numbers over a range like this are no radians and no metres
constexpr double range_of_counts = 50.0;

ChannelGuess describe(RawTable const& table, LikelyColumn const& likely) {
  ChannelGuess guess{likely.column, likely.name, likely.role};
  auto const& values = values_of(table, likely.column);
  bool any = false;
  for (double value : values) {
    if (std::isnan(value)) continue;
    guess.least = any ? std::min(guess.least, value) : value;
    guess.most = any ? std::max(guess.most, value) : value;
    any = true;
  }
  guess.is_constant = !(guess.most > guess.least);
  bool const says_si = likely.name.unit && tells_si(*likely.name.unit);
  bool const says_counts = likely.name.unit && likely.name.unit->quantity == Quantity::counts;
  guess.counts = says_counts || (!says_si && guess.most - guess.least > range_of_counts && whole_numbers(values));
  return guess;
}

// a column of 0 and 1 alone whose name says so: "torque_enabled", "drive_on", "MotorEnable"
bool is_switch(RawTable const& table, std::string const& column) {
  static std::vector<std::string> const words{"enable", "enabled", "on", "active"};
  std::string const said = " " + parse_column_name(column).rest + " ";
  auto const& values = values_of(table, column);
  return std::any_of(words.begin(), words.end(),
                     [&](auto const& word) { return said.find(" " + word + " ") != std::string::npos; }) &&
         std::any_of(values.begin(), values.end(), [](double v) { return !std::isnan(v); }) &&
         std::all_of(values.begin(), values.end(), [](double v) { return std::isnan(v) || v == 0.0 || v == 1.0; });
}

std::vector<LikelyColumn> switches_of(RawTable const& table) {
  std::vector<LikelyColumn> found;
  for (auto const& column : table.names)
    if (is_switch(table, column)) found.push_back({column, parse_column_name(column), {}});
  return found;
}

// what may serve as the channel and is no switch
std::vector<LikelyColumn> signals(RawTable const& table, std::string const& channel) {
  auto likely = likely_columns(channel, table.names, table.units);
  std::erase_if(likely, [&](LikelyColumn const& one) { return is_switch(table, one.column); });
  return likely;
}

// of one joint; the best that changes, else the best
ChannelGuess pick(RawTable const& table, std::vector<LikelyColumn> const& likely, Label const& label,
                  std::string const& joint) {
  std::vector<ChannelGuess> fitting;
  for (auto const& candidate : likely)
    if (label(candidate.name) == joint) fitting.push_back(describe(table, candidate));
  std::stable_partition(fitting.begin(), fitting.end(), [](ChannelGuess const& g) { return !g.is_constant; });
  if (fitting.empty()) return {};
  for (std::size_t k = 1; k < fitting.size(); ++k) fitting.front().others.push_back(fitting[k].column);
  return fitting.front();
}

std::vector<std::string> labels_of(std::vector<LikelyColumn> const& likely, Label const& label) {
  std::vector<std::string> labels;
  for (auto const& candidate : likely)
    if (auto text = label(candidate.name); std::find(labels.begin(), labels.end(), text) == labels.end())
      labels.push_back(std::move(text));
  return labels;
}

}  // namespace

ColumnGuess guess_columns(RawTable const& table, std::size_t joint, TorqueColumn torque) {
  auto const positions = signals(table, "position"), references = signals(table, "reference"),
             velocities = signals(table, "velocity"), switches = switches_of(table),
             torques = torque == TorqueColumn::required ? signals(table, "torque") : std::vector<LikelyColumn>{};
  Label const by_words = [](ColumnName const& name) { return name.rest + "#" + name.number; };
  Label const by_number = [](ColumnName const& name) { return name.number; };
  Label const all_one = [](ColumnName const&) { return std::string(); };

  // labels with a position and a torque, or in a file without one a reference, in the order of the file
  auto const joints_by = [&](Label const& label) {
    auto const have_torque = labels_of(torques.empty() ? references : torques, label);
    std::vector<LikelyColumn> in_file_order = positions;
    std::stable_sort(in_file_order.begin(), in_file_order.end(), [&](auto const& a, auto const& b) {
      return std::find(table.names.begin(), table.names.end(), a.column) <
             std::find(table.names.begin(), table.names.end(), b.column);
    });
    auto joints = labels_of(in_file_order, label);
    std::erase_if(joints, [&](std::string const& text) {
      return std::find(have_torque.begin(), have_torque.end(), text) == have_torque.end();
    });
    return joints;
  };
  Label label = by_words;
  auto joints = joints_by(by_words);
  if (joints.empty()) joints = joints_by(label = by_number);
  if (joints.empty()) {
    label = all_one;
    joints = {""};
  }

  ColumnGuess guess;
  guess.joints = joints.size();
  guess.joint = joint == 0 ? 1 : joint;
  std::vector<double> ranges;
  for (auto const& each : joints) {
    auto const position = pick(table, positions, label, each);
    ranges.push_back(position.most - position.least);
    if (!position.column.empty()) guess.positions.push_back(position.column);
  }
  if (guess.joint > guess.joints) return guess;
  constexpr double hardly = 0.05;
  auto const largest = std::max_element(ranges.begin(), ranges.end());
  auto const moves = [&](double range) { return range > hardly * *largest; };
  guess.moving_joints = static_cast<std::size_t>(std::count_if(ranges.begin(), ranges.end(), moves));
  guess.joint_that_moves =
      moves(ranges[guess.joint - 1]) ? guess.joint : static_cast<std::size_t>(largest - ranges.begin()) + 1;
  std::string const& chosen = joints[guess.joint - 1];
  guess.position = pick(table, positions, label, chosen);
  guess.torque = pick(table, torques, label, chosen);
  guess.reference = pick(table, references, label, chosen);
  guess.velocity = pick(table, velocities, label, chosen);
  // a name that says less, of a file with one joint: "goal" beside "motor position"
  if (guess.joints == 1 && guess.reference.column.empty()) guess.reference = pick(table, references, all_one, "");
  if (guess.joints == 1 && guess.velocity.column.empty()) guess.velocity = pick(table, velocities, all_one, "");
  // a torque of 0 in every row beside a current of another name
  if (auto const any = pick(table, torques, all_one, "");
      guess.joints == 1 && guess.torque.is_constant && !any.is_constant)
    guess.torque = any;
  // "drive_on" says no joint's name; where joints have one each, the number tells them apart
  guess.enabled = pick(table, switches, by_number, guess.position.name.number);
  if (guess.enabled.column.empty() && switches.size() == 1) guess.enabled = pick(table, switches, all_one, "");
  return guess;
}

}  // namespace torquescope
