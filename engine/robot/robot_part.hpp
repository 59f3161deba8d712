#pragma once
// Which part of a robot is the arm: from a link that is held to one that moves.

#include <string>

namespace torquescope {

struct RobotPart {
  std::string root{};  // the link that stands still, with all before it; "": the root of the file
  std::string tip{};   // the link where the arm ends; "": the end of the only path with moving joints

  bool is_whole() const { return root.empty() && tip.empty(); }
};

}  // namespace torquescope
