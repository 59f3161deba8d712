#include "engine/robot/robot_writers.hpp"

namespace torquescope {

namespace writers {
#define TORQUESCOPE_CHOICE(name) RobotWriter name();
#include "writer_choices.inc"
#undef TORQUESCOPE_CHOICE
}  // namespace writers

std::vector<RobotWriter> const& robot_writers() {
  static std::vector<RobotWriter> const choices{
#define TORQUESCOPE_CHOICE(name) writers::name(),
#include "writer_choices.inc"
#undef TORQUESCOPE_CHOICE
  };
  return choices;
}

}  // namespace torquescope
