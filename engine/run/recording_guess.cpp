#include "engine/run/recording_guess.hpp"

#include <algorithm>
#include <utility>

#include "engine/base/error.hpp"
#include "engine/data/recording_reader.hpp"
#include "engine/health/make_recording.hpp"

namespace torquescope {

namespace {

RecordingOptions options_of(RecordingGuess const& guess) {
  RecordingOptions options;
  options.columns = {{"time", guess.stamps->column},
                     {"position", guess.columns.position.column},
                     {"torque", guess.columns.torque.column}};
  if (reference_serves(guess.columns)) options.columns["reference"] = guess.columns.reference.column;
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
  add("torque_per_unit", options.torque_factor());
  return section;
}

void read_as_guessed(RecordingGuess& guess, RawTable const& table) {
  if (guess.columns.position.column.empty() || guess.columns.torque.column.empty()) {
    guess.refusal = "no column is known to be the position, or the torque";
    return;
  }
  if (!guess.stamps) {
    guess.refusal = "the rows have no time stamps that run forwards";
    return;
  }
  auto const options = options_of(guess);
  try {
    guess.recording = make_recording(table, options, written(options));
    guess.jitter = guess.recording->rows.jitter;
  } catch (Error const& refused) {
    guess.refusal = refused.problems().front().what;
  }
}

void take_units(RecordingGuess& guess) {
  auto const& position = guess.columns.position;
  if (position.name.unit && tells_si(*position.name.unit)) guess.position_per_unit = position.name.unit->si;
  auto const& torque = guess.columns.torque;
  if (torque_unit_is_known(torque) && torque.name.unit) guess.torque_per_unit = torque.name.unit->si;
}

}  // namespace

bool is_prismatic(ColumnGuess const& columns) {
  auto const& position = columns.position.name.unit;
  auto const& torque = columns.torque.name.unit;
  if (position && position->quantity == Quantity::length) return true;
  bool const turns = position && position->quantity == Quantity::angle;
  return !turns && torque && torque->quantity == Quantity::force;
}

bool torque_unit_is_known(ChannelGuess const& torque) {
  if (torque.name.unit) return tells_si(*torque.name.unit);
  return torque.role.quantity == WordKind::torque && !torque.counts;
}

bool reference_serves(ColumnGuess const& columns) {
  auto const& reference = columns.reference;
  if (reference.column.empty() || reference.is_constant) return false;
  auto const& unit = reference.name.unit;
  auto const& position = columns.position.name.unit;
  return !unit || !position || (unit->quantity == position->quantity && unit->si == position->si);
}

RecordingGuess guess_recording(std::filesystem::path const& file, std::size_t joint) {
  RecordingGuess guess;
  guess.file = file;
  RawTable const table = read_table(file, {"recording", {}, {}});
  guess.rows = table.columns.empty() ? 0 : table.columns.front().size();
  guess.columns = guess_columns(table, joint);
  guess.stamps = guess_stamps(table);
  guess.names = table.names;
  guess.unusable = table.unusable;
  take_units(guess);
  read_as_guessed(guess, table);
  return guess;
}

RecordingGuess guess_like(std::filesystem::path const& file, RecordingGuess const& first) {
  RecordingGuess guess;
  guess.file = file;
  RawTable const table = read_table(file, {"recording", {}, {}});
  guess.rows = table.columns.empty() ? 0 : table.columns.front().size();
  guess.columns = first.columns;
  guess.names = table.names;
  guess.unusable = table.unusable;
  take_units(guess);
  for (auto const* channel : {&first.columns.position, &first.columns.torque})
    if (std::find(table.names.begin(), table.names.end(), channel->column) == table.names.end())
      guess.refusal = "no column \"" + channel->column + "\"";
  if (!guess.refusal.empty()) return guess;
  guess.stamps = guess_stamps(table);
  read_as_guessed(guess, table);
  return guess;
}

}  // namespace torquescope
