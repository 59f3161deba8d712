#pragma once
// What the examination of a recording found: kind, rows, size and grade as numbers; health/finding_text.hpp says it.
//
// Rows       of the file's table, counted from 0; `lines` are what a person looks up (line of a text file, else row)
// Units      of the file's column, unless a kind says otherwise
// Threads    plain records

#include <cstdint>
#include <string>
#include <vector>

namespace torquescope {

enum class Grade { note, warning, fault };

enum class FindingKind {
  // time
  time_unit,          // size: s per unit of the stamps; detail: the unit's name
  time_unit_unknown,  // size: the step as it stands
  rows_out_of_order,  // sorted by time
  clock_rolls_over,   // size: s by which the stamps fall
  stamps_of_arrival,  // size: Hz of the even grid that replaced the stamps
  clock_was_set,      // size: s; position and torque go on as if nothing had happened
  rows_missing,       // size: s without rows, left out
  // position
  position_wraps,     // size: the modulus
  wraps_by_unknown,   // size: the modulus as far as the rows tell it
  position_jumps,     // size: the largest jump
  single_wrong_rows,  // size: the value most of them hold; in `column`
  sentinel,           // size: the value; in `column`
  rows_repeated,      // the joint moves and the rows do not change
  slow_source,        // size: Hz at which the column is renewed; detail: rows from one value to the next
  rows_interleaved,   // two sources of rows in one file
  position_in_counts,
  unit_in_name,         // size: SI value of one unit; detail: the unit's name; other: the key to write
  unit_of_current,      // detail: the unit's name
  speed_implausible,    // size: rad/s
  position_integrated,  // of the velocity in `column`, from zero; size: range of the motion, SI
  command_as_position,  // detail: the column that looks measured
  // torque
  torque_spikes,      // size: the largest
  unsigned_register,  // size: bits
  sign_magnitude,     // size: the bit of the sign
  torque_without_sign,
  torque_switched_off,   // size: s
  command_beyond_limit,  // size: share of the rows; detail: the limit; errors before and after
  torque_computed,       // detail: the reference's column; errors of the measured and the commanded motion
  torque_zero_steps,     // size: of the step, SI; detail: when; error_before: share that it explains
  torque_zero_drifts,    // size: over the recording, SI; error_before: share that it explains
  // velocity beside position
  velocity_contradicts,  // size: correlation with the derivative of the position
  velocity_factor,       // size: velocity over derivative of the position; detail: what it may be
  velocity_late,         // size: s
  velocity_constant,
  reference_factor,       // size: position over reference; detail: what it may be; errors before and after
  reference_constant,     // size: its value
  reference_is_position,  // size: rows by which the position is ahead of it
  // the fit of the job's model
  less_than_none,   // detail: the parameters and their values
  wrong_sign,       // as less_than_none, and the torque takes work out of the joint
  position_factor,  // size: the factor; detail: the unit, empty for a gear; errors before and after
  one_row_decides,  // size: s at which it stands; detail: what it moves, by how much, in standard errors
  // motion
  other_joints_move,  // detail: their columns
  arm_setup,          // detail: what is wrong with columns or robot file; line_to_write: what mends it
  arm_changes_at,     // size: s; detail: the gain; line_to_write: what leaves the rest out
  beyond_limits,      // size: share of the samples; detail: the limits
  standstill,         // size: the whole range of the motion, SI
  stretch_left_out,   // size: s, by the job or by missing values
  reader_remark,      // detail: what the reader of the file did
  arm_touched,        // size: s from which on; detail: until when, who feels it; line_to_write: leaves it out
};

// what was done about it
enum class Repair { none, corrected, filled, left_out, channel_unused };

struct Finding {
  FindingKind kind = FindingKind::reader_remark;
  Grade grade = Grade::warning;
  Repair repair = Repair::none;
  std::string recording{};
  std::string joint{};                  // of an arm: "joint 2 (elbow)"; empty: the whole recording
  std::vector<std::string> likewise{};  // further joints with the same finding
  std::string column{};                 // the file's name of it
  std::int64_t count = 0;
  std::vector<std::int64_t> lines{};  // the first few
  double size = 0.0;
  std::string detail{};
  std::string line_to_write{};                   // of the job
  std::string unit{};                            // of `size`, where it is SI
  double error_before = 0.0, error_after = 0.0;  // relative, of what a factor makes smaller
  double written = 1.0;                          // the factor that the job has already
};

}  // namespace torquescope
