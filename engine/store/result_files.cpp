#include "engine/store/result_files.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <string_view>

#include "engine/base/error.hpp"

namespace torquescope {

void refuse_long_name(std::filesystem::path const& result) {
  // the longest of all, with the largest process number of Linux and an attempt's number
  constexpr std::string_view longest_ending = ".made.json.tmp.4194304.999";
  auto const home = result.has_parent_path() ? result.parent_path() : std::filesystem::path(".");
  long const most = ::pathconf(home.c_str(), _PC_NAME_MAX);
  if (most <= 0) return;  // no limit, or no folder: who writes there says so
  std::size_t const room =
      static_cast<std::size_t>(most) - std::min(static_cast<std::size_t>(most), longest_ending.size());
  std::size_t const length = result.filename().native().size();
  validate(length <= room, [&] {
    return Problem{
        .code = ExitCode::usage,
        .what = fmt::format("the name of the result has {} bytes; {} are the most here", length, room),
        .notes = {fmt::format("files beside it have its name and more, and the file system allows {}", most)},
        .help = "--out a shorter name"};
  });
}

}  // namespace torquescope
