#pragma once
// Which columns of a table are likely the channels of one joint, and what its units make of them.
//
// Joints     columns belong together when their number and the words that say nothing are the same; where that leaves
//            no joint with position and torque, the number alone; then all columns are one joint
//            A channel that counts joints from 1 beside positions from 0 is counted anew (joint_numbers.hpp)
//            Without any torque: with position and reference
//            Without any position: with velocity and torque
// Switch     0 and 1 alone under a name that says enabled or on: never a torque
// Order      joints as their position columns stand in the file; `joint` counts them from 1
// Values     a column, or a joint, that never changes serves only where no other does; whole numbers without a unit
//            are counts
// Threads    free function

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "engine/data/column_suggestion.hpp"
#include "engine/data/joint_numbers.hpp"
#include "engine/data/recording_reader.hpp"
#include "engine/data/torque_column.hpp"

namespace torquescope {

struct ChannelGuess {
  std::string column;  // "": none
  ColumnName name;
  ColumnRole role;
  bool is_constant = false;
  bool counts = false;                // whole numbers, by unit or values: rad or m of one is unknown
  std::vector<std::string> others{};  // that could serve as well, best first
  double least = 0.0, most = 0.0;
};

struct ColumnGuess {
  ChannelGuess position, torque, reference, velocity, enabled;
  std::size_t joint = 1, joints = 1;
  std::vector<std::string> positions{};  // the position column of each joint, or in a file without any its velocity
  std::size_t moving_joints = 1;         // of them: over a twentieth of the largest range, and more
  std::vector<NumberShift> shifts{};     // columns of one joint that have different numbers
  std::size_t joint_that_moves = 1;      // `joint`, or where that hardly moves the one with the largest range
  bool passes_over_others = false;       // nobody asked for a joint, and those before `joint` cannot be fitted
};

// columns that a person named, by channel: position, torque, reference, time
using ChosenColumns = std::map<std::string, std::string>;

// named: these serve whatever their names say; they exist
// joint: from 1; 0 for that of a named position or torque, else the first that moves under a torque that
// changes. One beyond the file's gives no position and no torque
// torque: optional takes no column for it
ColumnGuess guess_columns(RawTable const& table, std::size_t joint = 0, TorqueColumn torque = TorqueColumn::required,
                          ChosenColumns const& named = {});

}  // namespace torquescope
