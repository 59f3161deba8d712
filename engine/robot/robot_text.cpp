#include "engine/robot/robot_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <system_error>

namespace torquescope {

namespace {

constexpr std::uintmax_t most_bytes = std::uintmax_t{16} << 20;

Problem file_problem(ExitCode code, std::string const& file, std::string what, std::string help) {
  Problem problem;
  problem.code = code;
  problem.what = std::move(what);
  problem.place.file = file;
  problem.help = std::move(help);
  return problem;
}

}  // namespace

RobotText RobotText::read(std::filesystem::path const& path) {
  std::string const file = path.string();
  std::error_code failure;
  validate(std::filesystem::is_regular_file(path, failure), [&] {
    return file_problem(ExitCode::no_input, file, fmt::format("there is no file {}", file),
                        "paths are relative to the file that names them, or to this folder");
  });
  auto const bytes = std::filesystem::file_size(path, failure);
  validate(!failure && bytes <= most_bytes, [&] {
    return file_problem(ExitCode::bad_data, file, fmt::format("{} has {} bytes, too many for a robot", file, bytes),
                        "a robot file is a text of some kilobytes: TOML or URDF, without meshes");
  });
  std::ifstream stream(path, std::ios::binary);
  std::string text(static_cast<std::size_t>(bytes), '\0');
  stream.read(text.data(), static_cast<std::streamsize>(bytes));
  validate(stream.good() || bytes == 0, [&] {
    return file_problem(ExitCode::io, file, fmt::format("{} cannot be read", file), "look at its permissions");
  });
  return {file, std::move(text)};
}

SourcePlace RobotText::place(std::size_t offset, std::size_t length) const {
  offset = std::min(offset, text.size());
  std::size_t const begin = offset == 0 ? 0 : text.rfind('\n', offset - 1) + 1;  // npos + 1 is 0
  std::size_t const end = std::min(text.find('\n', offset), text.size());
  SourcePlace place;
  place.file = file;
  place.line = 1 + static_cast<int>(std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(begin), '\n'));
  place.column = 1 + static_cast<int>(offset - begin);
  place.length = static_cast<int>(std::min(length, end - offset));
  place.line_text = text.substr(begin, end - begin);
  if (!place.line_text.empty() && place.line_text.back() == '\r') place.line_text.pop_back();
  return place;
}

}  // namespace torquescope
