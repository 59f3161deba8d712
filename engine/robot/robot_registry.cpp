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

namespace {

enum class Formats { all, with_links };

SerialChain read_one_of(Formats formats, std::filesystem::path const& path, RobotPart const& part) {
  auto const text = RobotText::read(path);
  Problem problem;
  for (auto const& format : robot_formats()) {
    if (formats == Formats::with_links && !format.has_links) continue;
    if (format.accepts(text)) return format.read(text, part);
    problem.notes.push_back(fmt::format("{}: {}", format.name, format.meaning));
  }
  problem.code = ExitCode::bad_data;
  problem.what = fmt::format("{} describes no robot", text.file);
  problem.place.file = text.file;
  problem.help = "write its joints in one of these formats; jobs/robots has examples";
  throw Error(std::move(problem));
}

}  // namespace

SerialChain read_robot(std::filesystem::path const& path, RobotPart const& part) {
  return read_one_of(Formats::all, path, part);
}

SerialChain read_linked_robot(std::filesystem::path const& path, RobotPart const& part) {
  return read_one_of(Formats::with_links, path, part);
}

std::optional<OtherConvention> read_robot_otherwise(std::filesystem::path const& path) {
  auto const text = RobotText::read(path);
  for (auto const& format : robot_formats())
    if (format.accepts(text))
      return format.read_otherwise != nullptr ? format.read_otherwise(text) : std::optional<OtherConvention>{};
  return {};
}

}  // namespace torquescope
