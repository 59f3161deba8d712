#pragma once
// One column of seconds out of the two whole numbers of a ROS time stamp.
//
// Equation   stamp = (sec - sec[0]) + nanosec * 1e-9: differences are exact to a nanosecond
// Names      x.sec + x.nanosec, x.secs + x.nsecs, x_sec + x_nsec; the new column is x when x ends in "stamp" or "time",
//            else x followed by "stamp"
// Threads    functions of their arguments
// Source     builtin_interfaces/msg/Time of ROS 2, std_msgs/Header of ROS 1

#include "engine/data/recording_reader.hpp"

namespace torquescope {

// adds a column for each such pair, and a remark that names it
void add_ros_stamps(RawTable& table);
// the column that was added for the whole seconds of that name; "": it is none of these
std::string stamp_with_fractions(RawTable const& table, std::string const& seconds);

}  // namespace torquescope
