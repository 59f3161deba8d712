#include "engine/data/recording_reader.hpp"

namespace torquescope {

OptionTable<RecordingOptions> const& RecordingOptions::table() {
  using Options = RecordingOptions;
  static OptionTable<Options> const table(
      "recording", "which files, which columns, which units",
      {{"train", &Options::train, "recordings the parameters are fitted to: paths relative to the job file"},
       {"validate", &Options::validate, "recordings no fit and no choice sees; they judge the result"},
       {"columns", &Options::columns,
        "channel = \"column\"; channels: time, position, torque (required), reference, velocity, acceleration"},
       {"torque_per_unit", &Options::torque_per_unit, "N m (or N) per unit of the torque column, e.g. N m per A"},
       {"position_per_unit", &Options::position_per_unit,
        "rad (or m) per unit of position, reference, velocity and acceleration columns; 0.0174532925 for degrees"},
       {"rate_hz", &Options::rate_hz, "Hz", 0.0, 1e7,
        "sampling rate of a file without time column; 0: columns.time is given"},
       {"delay_s", &Options::delay_s, "s", -10.0, 10.0,
        "added to the torque's time stamps; negative when the torque comes late"},
       {"gaps", &Options::gaps, {"error", "fill"}, "missing values: refuse them, or fill up to 5 in a row linearly"},
       {"simulated_torque", &Options::simulated_torque,
        "column with the torque (N m or N) of your own simulator on the same motion, neither scaled nor delayed; "
        "diagnose "
        "then explains what is left of the recording beside it"}});
  return table;
}

}  // namespace torquescope
