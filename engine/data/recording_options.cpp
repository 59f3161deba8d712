#include "engine/data/recording_reader.hpp"

namespace torquescope {

OptionTable<RecordingOptions> const& RecordingOptions::table() {
  using Options = RecordingOptions;
  static OptionTable<Options> const table(
      "recording", "which files, which columns, which units",
      {{"train", &Options::train, "recordings the parameters are fitted to: paths relative to the job file"},
       {"validate", &Options::validate, "recordings no fit and no choice sees; they judge the result"},
       {"train_share", &Options::train_share, "1", 0.05, 1.0,
        "share of every training recording, from its start, that parameters are fitted to; the rest joins validate"},
       {"columns", &Options::columns,
        "channel = \"column\"; channels: time, position, torque (required), reference, velocity, acceleration, and for "
        "rollouts added_command (to the drive's command), external_torque, enabled (0: the drive is off); of an arm "
        "\"q{j}_rad\" is q1_rad, q2_rad, ..., and {name} the joint's name"},
       {"clocks", &Options::clocks,
        "channel = \"column\" with the time stamps of that channel, where it has its own: \"X, Y, X, Y\" of an "
        "oscilloscope; the position is on columns.time, and all clocks count in one unit"},
       {"torque_per_unit", &Options::torque_per_unit,
        "N m (or N) per unit of the torque column, e.g. N m per A; of an arm one number, or one for each joint"},
       {"position_per_unit", &Options::position_per_unit,
        "rad (or m) per unit of position, reference, velocity and acceleration columns; 0.0174532925 for degrees"},
       {"velocity_per_unit", &Options::velocity_per_unit,
        "rad/s (or m/s) per unit of the velocity column: 0.104719755 for rpm; 0: position_per_unit"},
       {"time_per_unit", &Options::time_per_unit, "s", 1e-12, 3600.0,
        "seconds per unit of the time column: 1e-3 for milliseconds; where it is not written the column's name and the "
        "size of the stamps tell, and what was taken is said"},
       {"wrap", &Options::wrap, "1", 0.0, 1e12,
        "the position column counts modulo this (its own unit): 360, 6.283185307, 65536; 0: found from the recording"},
       {"encoding", &Options::encoding,
        "channel = \"unsigned16\" (two's complement that was read without its sign), \"sign_magnitude\" or "
        "\"plain\""},
       {"leave_out", &Options::leave_out,
        "stretches nobody should look at: [[from, until], ...] in s on the recording's own clock"},
       {"rate_hz", &Options::rate_hz, "Hz", 0.0, 1e7,
        "sampling rate of a file without time column; 0: columns.time is given"},
       {"delay_s", &Options::delay_s,
        "s, added to the torque's time stamps; negative when the torque comes late; of an arm one number, or one for "
        "each joint"},
       {"joint_sign", &Options::joint_sign,
        "of an arm: -1 for a joint that counts the other way round than its robot file, position and torque alike; "
        "one number for each joint"},
       {"zero", &Options::zero, "rad or m, added to the position and the reference; of an arm one for each joint"},
       {"position_order", &Options::position_order,
        "of an arm: which number ({j}) the position column of each joint has: [1, 3, 2] exchanges joints 2 and 3"},
       {"torque_order", &Options::torque_order, "the same of the torque columns"},
       {"torque_at",
        &Options::torque_at,
        {"joints", "motors"},
        "of an arm with motor_turns_by: whether the torque columns, times torque_per_unit, are those of the joints or "
        "of the motors on the joint side"},
       {"wrench", &Options::wrench,
        "of an arm: six columns, [\"fx\", \"fy\", \"fz\", \"mx\", \"my\", \"mz\"] in N and N m, of a sensor or "
        "a force plate: a known torque of each joint, which is added to its own before any fit; effects of the gear's "
        "load do not feel it"},
       {"wrench_frame",
        &Options::wrench_frame,
        {"tip", "base"},
        "axes of wrench, in the robot file: those of the tip (the flange), or of the base; it acts at the tip's origin "
        "either way"},
       {"wrench_on",
        &Options::wrench_on,
        {"arm", "surroundings"},
        "on whom wrench acts: arm: what the surroundings do to the arm (pressed down on a table, it is pushed up); "
        "surroundings: what the arm does to them"},
       {"gaps",
        &Options::gaps,
        {"error", "fill"},
        "missing values: refuse them, or fill up to 5 in a row over time and leave longer stretches out"},
       {"simulated_torque", &Options::simulated_torque,
        "column with the torque (N m or N) of your own simulator on the same motion, neither scaled nor delayed; "
        "diagnose "
        "then explains what is left of the recording beside it"},
       {"simulated_position", &Options::simulated_position,
        "column with the position that your own simulator reaches from the same reference; replay sets it beside the "
        "recording"},
       {"payload_kg",
        &Options::payload_kg,
        {"unknown"},
        "of an arm: mass that its last link carries, weighed, one number for each training recording; 0: none; "
        "[0, \"unknown\"]: wls finds mass and centre of the second one's load"},
       {"payload_first_moments_kgm", &Options::payload_first_moments_kgm,
        "kg m, in the last link's frame: x, y, z of each training recording; none: they are parameters, as the "
        "payload's inertia"},
       {"validate_payload_kg",
        &Options::validate_payload_kg,
        {"unknown"},
        "of each validation recording: the mass of one of the training payloads, or 0"}});
  return table;
}

}  // namespace torquescope
