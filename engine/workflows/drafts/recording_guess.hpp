#pragma once
// A recording as `torquescope init` takes it to be: its columns, units and stamps guessed, then read like any other.
//
// Errors     read_table()'s: 66, 65. What else is wrong with the recording stands in `refusal`
// Threads    free functions

#include <filesystem>
#include <map>
#include <optional>
#include <string>

#include "engine/data/column_guess.hpp"
#include "engine/data/column_look.hpp"
#include "engine/data/finding.hpp"
#include "engine/data/recording.hpp"
#include "engine/data/stamp_guess.hpp"

namespace torquescope {

struct RecordingGuess {
  std::filesystem::path file;
  TorqueColumn torque = TorqueColumn::required;
  std::size_t rows = 0;
  ColumnGuess columns{};
  std::optional<StampGuess> stamps{};
  std::map<std::string, std::string> clocks{};  // of channels whose time column is not the position's
  bool is_speed_alone = false;                  // no position, and no column whose derivative the velocity would be
  std::vector<std::string> names{};             // all columns of the file
  std::vector<UnusableColumn> unusable{};       // of them, those that hold text
  double position_per_unit = 1.0, torque_per_unit = 1.0;  // 1 where the unit does not tell
  std::optional<Recording> recording{};                   // in SI units as far as they are known
  std::optional<Finding> no_command{};                    // of a reference that was taken out of `columns`
  ChosenColumns named{};                                  // by a person
  std::vector<ColumnLook> looks{};                        // where the position or the torque is not known
  std::string refusal{};                                  // why there is none
  double jitter = 0.0;                                    // of the stamps
  double velocity_per_unit = 1.0;                         // of a speed alone

  // the column that says how the joint moves: the position, or a speed alone
  ChannelGuess const& motion() const { return is_speed_alone ? columns.velocity : columns.position; }
};

// joint, torque, named: as guess_columns(); Error 64 where there is no column of a name
RecordingGuess guess_recording(std::filesystem::path const& file, std::size_t joint,
                               TorqueColumn torque = TorqueColumn::required, ChosenColumns const& named = {});
// another recording with the columns of the first
RecordingGuess guess_like(std::filesystem::path const& file, RecordingGuess const& first);

// by the units of position, velocity and torque
bool is_prismatic(ColumnGuess const& columns);
bool torque_unit_is_known(ChannelGuess const& torque);
// the reference counts when its unit is the position's; to `serve` it has to change
bool reference_fits(ColumnGuess const& columns);
bool reference_serves(ColumnGuess const& columns);
// a position and its command, and no torque that changes
bool is_servo(ColumnGuess const& columns);

}  // namespace torquescope
