#pragma once
// Arms to files. A writer is one file in writers/ and one word in CMakeLists.txt.
//
// Accuracy   numbers have all their digits: the arm that is read again has the torques of the one that was written
// Lost       TOML: where frame 0 stands. URDF: gears, drive inertias, encoders, accelerations, the size of gravity.
//            MJCF: gears, encoders, speeds, accelerations and torques. Each file says so
// Threads    pure functions

#include <string>
#include <vector>

#include "engine/robot/serial_chain.hpp"

namespace torquescope {

struct RobotWriter {
  std::string name;     // "urdf", also the ending of its files
  std::string meaning;  // "Unified Robot Description Format"
  bool needs_inertias;  // MuJoCo moves nothing without a mass
  // notes: sentences that go with the file. Requires bodies (body_fault()) where the chain has inertias
  std::string (*write)(SerialChain const& chain, std::vector<std::string> const& notes);
};

std::vector<RobotWriter> const& robot_writers();

}  // namespace torquescope
