// Rows of ros2 topic echo --csv: engine/data/readers/ros_echo.cpp.
#include "tests/fuzz/hostile_reader.hpp"

namespace torquescope {

HostileReader const hostile_ros_echo{.read = [](std::string_view bytes) { read_recording("ros_echo", bytes); }};

}  // namespace torquescope
