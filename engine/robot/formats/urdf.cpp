// Robot files in URDF, as ROS has them.

#include <fmt/format.h>

#include "engine/robot/robot_registry.hpp"
#include "engine/robot/urdf_chain.hpp"

namespace torquescope::formats {

namespace {

bool accepts(RobotText const& text) {
  auto const first = text.text.find_first_not_of(" \t\r\n\xef\xbb\xbf");
  return first != std::string::npos && text.text[first] == '<' && text.text.find("<robot") != std::string::npos;
}

SerialChain read(RobotText const& text) {
  auto const macro = text.text.find("<xacro:");
  validate(macro == std::string::npos, [&] {
    Problem problem;
    problem.code = ExitCode::bad_data;
    problem.what = fmt::format("{} is a xacro, from which a URDF is still to be made", text.file);
    problem.place = text.place(macro, 7);
    problem.help = fmt::format("write it out first: xacro {} > robot.urdf", text.file);
    return problem;
  });
  return read_urdf_chain(text, "");
}

}  // namespace

RobotFormat urdf() {
  return {"urdf", "Unified Robot Description Format (XML); fixed joints are merged", accepts, read};
}

}  // namespace torquescope::formats
