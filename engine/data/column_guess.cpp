#include "engine/data/column_guess.hpp"

#include <algorithm>
#include <cmath>
#include <functional>

#include "engine/base/order_statistic.hpp"
#include "engine/data/clock_blocks.hpp"
#include "engine/data/columns.hpp"
#include "engine/data/joint_numbers.hpp"

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

// what may serve as the channel and is no switch, nor the clock of a block ("Position.X")
std::vector<LikelyColumn> signals(RawTable const& table, std::string const& channel) {
  auto likely = likely_columns(channel, table.names, table.units);
  auto const clocks = clocks_of_columns(table);
  std::erase_if(likely, [&](LikelyColumn const& one) {
    bool const is_clock =
        std::any_of(clocks.begin(), clocks.end(), [&](auto const& of) { return of.second == one.column; });
    return is_clock || is_switch(table, one.column);
  });
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

namespace {

// of the position or speed that says how a joint moves; without the outermost rows, which may be sentinels
double travel(RawTable const& table, std::string const& column) {
  constexpr double outermost = 0.02;  // of the rows, at either end
  std::vector<double> values;
  for (double value : values_of(table, column))
    if (!std::isnan(value)) values.push_back(value);
  if (values.empty()) return 0.0;
  auto const left_out = static_cast<std::size_t>(outermost * static_cast<double>(values.size()));
  auto const at_rank = [&](std::size_t rank) {
    return kth_smallest(
        [&](auto const& visit) {
          for (double value : values) visit(value);
        },
        rank);
  };
  return at_rank(values.size() - 1 - left_out) - at_rank(left_out);
}

// all that may serve as a channel, of any joint
struct Candidates {
  std::vector<LikelyColumn> positions, torques, references, velocities, switches;
  std::vector<LikelyColumn> leads;    // whose joints are counted: positions, in a file without any the velocities
  std::vector<NumberShift> shifts{};  // of torques and references

  Candidates(RawTable const& table, TorqueColumn torque)
      : positions(signals(table, "position")),
        torques(torque == TorqueColumn::required ? signals(table, "torque") : std::vector<LikelyColumn>{}),
        references(signals(table, "reference")),
        velocities(signals(table, "velocity")),
        switches(switches_of(table)),
        leads(positions.empty() ? velocities : positions) {
    for (auto* channel : {&torques, &references})
      if (auto const shift = number_like(leads, *channel)) shifts.push_back(*shift);
    number_like(leads, velocities);
  }
};

// labels with a position and a torque, or in a file without one a reference, in the order of the file
std::vector<std::string> joints_by(Label const& label, Candidates const& all, std::vector<std::string> const& names) {
  auto const have_torque = labels_of(all.torques.empty() ? all.references : all.torques, label);
  std::vector<LikelyColumn> in_file_order = all.leads;
  std::stable_sort(in_file_order.begin(), in_file_order.end(), [&](auto const& a, auto const& b) {
    return std::find(names.begin(), names.end(), a.column) < std::find(names.begin(), names.end(), b.column);
  });
  auto joints = labels_of(in_file_order, label);
  std::erase_if(joints, [&](std::string const& text) {
    return std::find(have_torque.begin(), have_torque.end(), text) == have_torque.end();
  });
  return joints;
}

// the numbers alone say the joint: no two joints of other names share one
bool numbers_tell(std::vector<std::string> const& joints) {
  std::vector<std::string> numbers;
  for (auto const& joint : joints) numbers.push_back(joint.substr(joint.rfind('#') + 1));
  std::sort(numbers.begin(), numbers.end());
  return std::adjacent_find(numbers.begin(), numbers.end()) == numbers.end();
}

// from 1: that of a column that a person named; 0 where no joint has it
std::size_t joint_of(ChosenColumns const& named, Candidates const& all, Label const& label,
                     std::vector<std::string> const& joints) {
  for (auto const& [channel, likely] : {std::pair{"position", &all.leads}, std::pair{"torque", &all.torques}})
    for (auto const& one : *likely) {
      auto const given = named.find(channel);
      if (given == named.end() || one.column != given->second) continue;
      auto const at = std::find(joints.begin(), joints.end(), label(one.name));
      if (at != joints.end()) return static_cast<std::size_t>(at - joints.begin()) + 1;
    }
  return 0;
}

void take_named(RawTable const& table, ChosenColumns const& named, ColumnGuess& guess) {
  std::map<std::string, ChannelGuess*> const channels{
      {"position", &guess.position}, {"torque", &guess.torque}, {"reference", &guess.reference}};
  for (auto const& [channel, column] : named) {
    auto const at = channels.find(channel);
    if (at == channels.end() || at->second->column == column) continue;
    auto const c = std::find(table.names.begin(), table.names.end(), column) - table.names.begin();
    auto const k = static_cast<std::size_t>(c);
    auto const name = parse_column_name(column, k < table.units.size() ? table.units[k] : "");
    *at->second = describe(table, {column, name, column_role(name)});
  }
  // a guess must not stand in two places
  for (auto const& [channel, other] : channels)
    if (!named.contains(channel))
      for (auto const& [its_channel, column] : named)
        if (other->column == column) *other = {};
}

}  // namespace

ColumnGuess guess_columns(RawTable const& table, std::size_t joint, TorqueColumn torque, ChosenColumns const& named) {
  Candidates const all(table, torque);
  Label const by_words = [](ColumnName const& name) { return name.rest + "#" + name.number; };
  Label const by_number = [](ColumnName const& name) { return name.number; };
  Label const all_one = [](ColumnName const&) { return std::string(); };
  Label label = by_words;
  auto joints = joints_by(by_words, all, table.names);
  if (joints.empty()) joints = joints_by(label = by_number, all, table.names);
  if (joints.empty()) {
    label = all_one;
    joints = {""};
  }
  bool const number_serves = numbers_tell(joints);
  // of one joint: by its label; where that has nothing that moves, or a command alone, what shares its number, or of
  // one joint anything
  auto const pick_of = [&](std::vector<LikelyColumn> const& likely, std::string const& one) {
    auto found = pick(table, likely, label, one);
    auto const take_moving = [&](ChannelGuess other) {
      bool const is_measured = found.role.commanded && !other.role.commanded;
      bool const is_better = found.column.empty() || (!other.is_constant && (found.is_constant || is_measured));
      if (!other.column.empty() && is_better) found = std::move(other);
    };
    if (number_serves && !one.empty()) take_moving(pick(table, likely, by_number, one.substr(one.rfind('#') + 1)));
    if (joints.size() == 1) take_moving(pick(table, likely, all_one, ""));
    return found;
  };

  ColumnGuess guess;
  guess.shifts = all.shifts;
  guess.joints = joints.size();
  if (joint == 0) joint = joint_of(named, all, label, joints);
  guess.joint = joint == 0 ? 1 : joint;
  std::vector<double> ranges;
  for (auto const& each : joints) {
    auto const lead = pick(table, all.leads, label, each);
    ranges.push_back(lead.column.empty() ? 0.0 : travel(table, lead.column));
    if (!lead.column.empty()) guess.positions.push_back(lead.column);
  }
  if (guess.joint > guess.joints) return guess;
  constexpr double hardly = 0.05;
  auto const largest = std::max_element(ranges.begin(), ranges.end());
  auto const moves = [&](double range) { return range > hardly * *largest; };
  guess.moving_joints = static_cast<std::size_t>(std::count_if(ranges.begin(), ranges.end(), moves));
  // nobody asked for one: the first that moves under a torque that changes
  for (std::size_t k = 0; joint == 0 && k < joints.size(); ++k) {
    bool const can_be_fitted =
        moves(ranges[k]) && (torque == TorqueColumn::optional || !pick_of(all.torques, joints[k]).is_constant);
    if (!can_be_fitted) continue;
    guess.joint = k + 1;
    guess.passes_over_others = k > 0;
    break;
  }
  guess.joint_that_moves =
      moves(ranges[guess.joint - 1]) ? guess.joint : static_cast<std::size_t>(largest - ranges.begin()) + 1;
  std::string const& chosen = joints[guess.joint - 1];
  guess.position = pick(table, all.positions, label, chosen);
  guess.torque = pick_of(all.torques, chosen);
  guess.reference = pick_of(all.references, chosen);
  guess.velocity = pick_of(all.velocities, chosen);
  // "drive_on" says no joint's name; where joints have one each, the number tells them apart
  auto const& lead = guess.position.column.empty() ? guess.velocity : guess.position;
  guess.enabled = pick(table, all.switches, by_number, lead.name.number);
  if (guess.enabled.column.empty() && all.switches.size() == 1) guess.enabled = pick(table, all.switches, all_one, "");
  take_named(table, named, guess);
  return guess;
}

}  // namespace torquescope
