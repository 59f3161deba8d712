#include "engine/robot/robot_registry.hpp"

#include <fmt/format.h>

namespace torquescope {

namespace formats {
#define TORQUESCOPE_CHOICE(name) RobotFormat name();
#include "format_choices.inc"
#undef TORQUESCOPE_CHOICE
}  // namespace formats

std::vector<RobotFormat> const& robot_formats() {
  static std::vector<RobotFormat> const choices{
#define TORQUESCOPE_CHOICE(name) formats::name(),
#include "format_choices.inc"
#undef TORQUESCOPE_CHOICE
  };
  return choices;
}

SerialChain read_robot(std::filesystem::path const& path) {
  auto const text = RobotText::read(path);
  for (auto const& format : robot_formats())
    if (format.accepts(text)) return format.read(text);
  Problem problem;
  problem.code = ExitCode::bad_data;
  problem.what = fmt::format("{} describes no robot", text.file);
  problem.place.file = text.file;
  for (auto const& format : robot_formats())
    problem.notes.push_back(fmt::format("{}: {}", format.name, format.meaning));
  problem.help = "write its joints in one of these formats; jobs/robots has examples";
  throw Error(std::move(problem));
}

std::optional<OtherConvention> read_robot_otherwise(std::filesystem::path const& path) {
  auto const text = RobotText::read(path);
  for (auto const& format : robot_formats())
    if (format.accepts(text))
      return format.read_otherwise != nullptr ? format.read_otherwise(text) : std::optional<OtherConvention>{};
  return {};
}

}  // namespace torquescope
