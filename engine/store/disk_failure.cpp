#include "engine/store/disk_failure.hpp"

#include <fmt/format.h>

#include <cctype>
#include <cerrno>
#include <cstring>
#include <string>
#include <system_error>

namespace torquescope {
namespace {

namespace fs = std::filesystem;

std::string reason_of(int error_number) {
  std::string text = std::strerror(error_number);
  text.front() = static_cast<char>(std::tolower(static_cast<unsigned char>(text.front())));
  return text;
}

std::string help_for(int error_number) {
  switch (error_number) {
    case ENOSPC:
    case EDQUOT:
      return "make room there (or choose another folder) and run the same command again";
    case EFBIG:
      return "raise the limit on file sizes (ulimit -f) and run the same command again";
    case ENOENT:
      return "make the folder first, or write to another one";
    case EACCES:
    case EPERM:
    case EROFS:
      return "write to a folder that is yours";
    default:
      return "check the disk, or write to another folder; then run the same command again";
  }
}

}  // namespace

std::optional<std::uintmax_t> free_bytes_for(fs::path const& name) {
  std::error_code unknown;
  fs::space_info const space = fs::space(name.has_parent_path() ? name.parent_path() : fs::path("."), unknown);
  if (unknown) return std::nullopt;
  return space.available;
}

Error cannot_write(fs::path const& name, int error_number, std::uintmax_t needed) {
  Problem problem{.code = ExitCode::io,
                  .what = fmt::format("cannot write {}: {}", name.string(), reason_of(error_number))};
  if (error_number == ENOSPC || error_number == EDQUOT) {
    auto const free = free_bytes_for(name);
    std::string const free_words = free ? fmt::format("{} bytes are free there", *free) : "";
    std::string const limit_words = error_number == EDQUOT ? ", but your quota is used up" : "";
    if (needed > 0) problem.notes.push_back(fmt::format("{} bytes or more are needed", needed));
    if (free) problem.notes.push_back(free_words + limit_words);
  }
  problem.help = help_for(error_number);
  return Error(problem);
}

Error no_such_result(fs::path const& name) {
  return Error(Problem{.code = ExitCode::no_input,
                       .what = "there is no file " + name.string(),
                       .help = fmt::format("torquescope run JOB.toml --out {} makes a result of a fit; diagnose and "
                                           "replay, in place of run, make theirs",
                                           name.string())});
}

Error cannot_read(fs::path const& name, int error_number) {
  if (error_number == ENOENT) return no_such_result(name);
  return Error(Problem{.code = ExitCode::io,
                       .what = fmt::format("cannot read {}: {}", name.string(), reason_of(error_number)),
                       .help = "check the disk, then run the same command again; nothing was changed"});
}

}  // namespace torquescope
