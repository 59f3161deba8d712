#include "engine/data/health/finding_text.hpp"

namespace torquescope {

std::string code_of(FindingKind kind) {
  using enum FindingKind;
  switch (kind) {
    case time_unit:
      return "time_unit";
    case time_unit_unknown:
      return "time_unit_unknown";
    case rows_out_of_order:
      return "rows_out_of_order";
    case clock_rolls_over:
      return "clock_rolls_over";
    case stamps_of_arrival:
      return "stamps_of_arrival";
    case clock_was_set:
      return "clock_was_set";
    case rows_missing:
      return "rows_missing";
    case position_wraps:
      return "position_wraps";
    case wraps_by_unknown:
      return "wraps_by_unknown";
    case position_jumps:
      return "position_jumps";
    case single_wrong_rows:
      return "single_wrong_rows";
    case rows_repeated:
      return "rows_repeated";
    case sentinel:
      return "sentinel";
    case slow_source:
      return "slow_source";
    case rows_interleaved:
      return "rows_interleaved";
    case position_in_counts:
      return "position_in_counts";
    case unit_in_name:
      return "unit_in_name";
    case unit_of_current:
      return "unit_of_current";
    case speed_implausible:
      return "speed_implausible";
    case position_integrated:
      return "position_integrated";
    case command_as_position:
      return "command_as_position";
    case torque_spikes:
      return "torque_spikes";
    case unsigned_register:
      return "unsigned_register";
    case sign_magnitude:
      return "sign_magnitude";
    case torque_without_sign:
      return "torque_without_sign";
    case torque_switched_off:
      return "torque_switched_off";
    case command_beyond_limit:
      return "command_beyond_limit";
    case torque_computed:
      return "torque_computed";
    case torque_zero_steps:
      return "torque_zero_steps";
    case torque_zero_drifts:
      return "torque_zero_drifts";
    case velocity_contradicts:
      return "velocity_contradicts";
    case velocity_factor:
      return "velocity_factor";
    case velocity_late:
      return "velocity_late";
    case velocity_constant:
      return "velocity_constant";
    case less_than_none:
      return "less_than_none";
    case wrong_sign:
      return "wrong_sign";
    case position_factor:
      return "position_factor";
    case reference_factor:
      return "reference_factor";
    case reference_constant:
      return "reference_constant";
    case reference_is_position:
      return "reference_is_position";
    case one_row_decides:
      return "one_row_decides";
    case other_joints_move:
      return "other_joints_move";
    case arm_setup:
      return "arm_setup";
    case arm_changes_at:
      return "arm_changes_at";
    case beyond_limits:
      return "beyond_limits";
    case standstill:
      return "standstill";
    case stretch_left_out:
      return "stretch_left_out";
    case reader_remark:
      return "reader_remark";
  }
  return {};
}

}  // namespace torquescope
