#include "engine/workflows/drafts/recording_guess.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <utility>

#include "engine/base/error.hpp"
#include "engine/data/clock_blocks.hpp"
#include "engine/data/health/make_recording.hpp"
#include "engine/data/recording_reader.hpp"

namespace torquescope {

namespace {

RecordingOptions options_of(RecordingGuess const& guess) {
  RecordingOptions options;
  bool const has_torque = guess.torque == TorqueColumn::required;
  options.columns = {{"time", guess.stamps->column},
                     {guess.is_speed_alone ? "velocity" : "position", guess.motion().column}};
  if (has_torque) options.columns["torque"] = guess.columns.torque.column;
  if (has_torque ? reference_serves(guess.columns) : reference_fits(guess.columns))
    options.columns["reference"] = guess.columns.reference.column;
  options.clocks = guess.clocks;
  std::erase_if(options.clocks, [&](auto const& one) { return !options.columns.contains(one.first); });
  if (guess.is_speed_alone) options.velocity_per_unit = guess.velocity_per_unit;
  options.time_per_unit = guess.stamps->per_unit;
  options.position_per_unit = guess.position_per_unit;
  options.torque_per_unit = {guess.torque_per_unit};
  return options;
}

// as if the job had written what is not 1: the examination asks whether a unit was stated
Section written(RecordingOptions const& options) {
  Section section{"recording", {}, {}};
  auto const add = [&](char const* key, double value) {
    if (value != 1.0) section.settings.push_back({key, value});
  };
  add("time_per_unit", options.time_per_unit);
  add("position_per_unit", options.position_per_unit);
  if (options.velocity_per_unit != 0.0) add("velocity_per_unit", options.velocity_per_unit);
  add("torque_per_unit", options.torque_factor());
  return section;
}

// beside a torque a reference that is no command helps nobody; of a servo it is all there is
void take_out_no_command(RecordingGuess& guess) {
  for (auto const& finding : guess.recording->findings) {
    bool const is_none =
        finding.kind == FindingKind::reference_constant || finding.kind == FindingKind::reference_is_position;
    if (!is_none || finding.repair != Repair::channel_unused) continue;
    guess.no_command = finding;
    guess.columns.reference = {};
  }
}

void read_as_guessed(RecordingGuess& guess, RawTable const& table) {
  bool const needs_torque = guess.torque == TorqueColumn::required;
  if (guess.motion().column.empty() || (needs_torque && guess.columns.torque.column.empty())) {
    guess.refusal =
        needs_torque ? "no column is known to be the position, or the torque" : "no column is known to be the position";
    return;
  }
  if (!guess.stamps) {
    guess.refusal = "the rows have no time stamps that run forwards";
    return;
  }
  auto const options = options_of(guess);
  try {
    guess.recording = make_recording(table, options, written(options), OtherJoints::ignored, guess.torque);
    guess.jitter = guess.recording->rows.jitter;
    take_out_no_command(guess);
  } catch (Error const& refused) {
    guess.refusal = refused.problems().front().what;
  }
}

void take_units(RecordingGuess& guess) {
  auto const& position = guess.columns.position;
  if (position.name.unit && tells_si(*position.name.unit)) guess.position_per_unit = position.name.unit->si;
  auto const& velocity = guess.columns.velocity;
  if (velocity.name.unit && tells_si(*velocity.name.unit)) guess.velocity_per_unit = velocity.name.unit->si;
  auto const& torque = guess.columns.torque;
  if (torque_unit_is_known(torque) && torque.name.unit) guess.torque_per_unit = torque.name.unit->si;
}

}  // namespace

bool is_prismatic(ColumnGuess const& columns) {
  auto const& motion = columns.position.column.empty() ? columns.velocity.name.unit : columns.position.name.unit;
  auto const& torque = columns.torque.name.unit;
  auto const is = [&](Quantity quantity) { return motion && motion->quantity == quantity; };
  if (is(Quantity::length) || is(Quantity::speed)) return true;
  bool const turns = is(Quantity::angle) || is(Quantity::angular_speed);
  return !turns && torque && torque->quantity == Quantity::force;
}

bool torque_unit_is_known(ChannelGuess const& torque) {
  if (torque.name.unit) return tells_si(*torque.name.unit);
  return torque.role.quantity == WordKind::torque && !torque.counts;
}

bool reference_fits(ColumnGuess const& columns) {
  auto const& reference = columns.reference;
  if (reference.column.empty()) return false;
  auto const& unit = reference.name.unit;
  auto const& position = columns.position.name.unit;
  return !unit || !position || (unit->quantity == position->quantity && unit->si == position->si);
}

bool reference_serves(ColumnGuess const& columns) { return reference_fits(columns) && !columns.reference.is_constant; }

bool is_servo(ColumnGuess const& columns) {
  bool const has_torque = !columns.torque.column.empty() && !columns.torque.is_constant;
  return !has_torque && !columns.position.column.empty() && reference_fits(columns);
}

void check_named(RawTable const& table, ChosenColumns const& named) {
  for (auto const& [channel, column] : named)
    validate(std::find(table.names.begin(), table.names.end(), column) != table.names.end(),
             [&table, &channel = channel, &column = column] {
               auto const text = std::find_if(table.unusable.begin(), table.unusable.end(),
                                              [&](auto const& one) { return one.name == column; });
               Problem problem;
               problem.code = ExitCode::usage;
               problem.what =
                   text != table.unusable.end()
                       ? fmt::format("--{} \"{}\" cannot serve: the column {}", channel, column, text->reason)
                       : fmt::format("--{} \"{}\": {} has no such column", channel, column,
                                     std::filesystem::path(table.path).filename().string());
               problem.help = fmt::format("the file has {}", fmt::join(table.names, ", "));
               return problem;
             });
}

namespace {

// of a joint with a torque: a command's error needs the position itself
void take_speed_alone(RecordingGuess& guess) {
  auto const& velocity = guess.columns.velocity;
  bool const is_derivative = std::any_of(guess.looks.begin(), guess.looks.end(), [&](ColumnLook const& look) {
    return look.column == velocity.column && look.look == Look::derivative;
  });
  guess.is_speed_alone = guess.torque == TorqueColumn::required && guess.columns.position.column.empty() &&
                         !velocity.column.empty() && !velocity.is_constant && !is_derivative;
  if (!guess.is_speed_alone) return;
  guess.columns.reference = {};
  if (!guess.columns.torque.column.empty()) guess.looks.clear();
}

// the time column of the position's block, and of channels in other blocks
void guess_clocks(RecordingGuess& guess, RawTable const& table) {
  auto const of_columns = clocks_of_columns(table);
  auto const own = of_columns.find(guess.motion().column);
  std::string named = guess.named.contains("time") ? guess.named.at("time") : "";
  if (named.empty() && own != of_columns.end()) named = own->second;
  guess.stamps = guess_stamps(table, named);
  if (!guess.stamps || own == of_columns.end() || own->second != guess.stamps->column) return;
  for (auto const& [channel, column] :
       {std::pair{"torque", guess.columns.torque.column}, std::pair{"reference", guess.columns.reference.column},
        std::pair{"enabled", guess.columns.enabled.column}}) {
    auto const at = of_columns.find(column);
    if (at != of_columns.end() && !is_same_clock(table, at->second, own->second)) guess.clocks[channel] = at->second;
  }
}

}  // namespace

RecordingGuess guess_recording(std::filesystem::path const& file, std::size_t joint, TorqueColumn torque,
                               ChosenColumns const& named) {
  RecordingGuess guess;
  guess.file = file;
  guess.torque = torque;
  RawTable const table = read_table(file, {"recording", {}, {}});
  guess.rows = table.columns.empty() ? 0 : table.columns.front().size();
  check_named(table, named);
  guess.named = named;
  guess.columns = guess_columns(table, joint, torque, named);
  bool const lacks_torque = torque == TorqueColumn::required && guess.columns.torque.column.empty();
  if (guess.columns.position.column.empty() || lacks_torque) guess.looks = column_looks(table);
  take_speed_alone(guess);
  guess_clocks(guess, table);
  guess.names = table.names;
  guess.unusable = table.unusable;
  take_units(guess);
  read_as_guessed(guess, table);
  return guess;
}

RecordingGuess guess_like(std::filesystem::path const& file, RecordingGuess const& first) {
  RecordingGuess guess;
  guess.file = file;
  guess.torque = first.torque;
  RawTable const table = read_table(file, {"recording", {}, {}});
  guess.rows = table.columns.empty() ? 0 : table.columns.front().size();
  guess.columns = first.columns;
  guess.names = table.names;
  guess.unusable = table.unusable;
  take_units(guess);
  bool const has_torque = first.torque == TorqueColumn::required;
  guess.is_speed_alone = first.is_speed_alone;
  guess.clocks = first.clocks;
  for (auto const* channel : {&first.motion(), has_torque ? &first.columns.torque : &first.columns.reference})
    if (std::find(table.names.begin(), table.names.end(), channel->column) == table.names.end())
      guess.refusal = "no column \"" + channel->column + "\"";
  if (!guess.refusal.empty()) return guess;
  std::string named = first.named.contains("time") ? first.named.at("time") : "";
  if (named.empty() && !first.clocks.empty() && first.stamps) named = first.stamps->column;
  bool const has_clocks = std::all_of(first.clocks.begin(), first.clocks.end(), [&](auto const& one) {
    return std::find(table.names.begin(), table.names.end(), one.second) != table.names.end();
  });
  if (!has_clocks ||
      (!named.empty() && std::find(table.names.begin(), table.names.end(), named) == table.names.end())) {
    guess.refusal = "its time columns have other names";
    return guess;
  }
  guess.stamps = guess_stamps(table, named);
  read_as_guessed(guess, table);
  return guess;
}

}  // namespace torquescope
