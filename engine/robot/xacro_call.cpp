#include "engine/robot/xacro_call.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <filesystem>
#include <optional>
#include <vector>

#include "engine/base/memory_file.hpp"

extern char** environ;

namespace torquescope {

namespace {

constexpr std::size_t most_urdf_bytes = std::size_t{16} << 20;  // as of a robot file
constexpr std::size_t most_words_shown = 400;                   // of what xacro says

struct Written {
  int status = 0;  // -1: killed
  std::string out{}, err{};
};

std::string bytes_of(MemoryFile const& file) {
  int const descriptor = ::open(file.path().c_str(), O_RDONLY | O_CLOEXEC);
  std::string bytes;
  std::array<char, 65536> part{};
  while (descriptor >= 0 && bytes.size() <= most_urdf_bytes) {
    auto const count = ::read(descriptor, part.data(), part.size());
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) break;
    bytes.append(part.data(), static_cast<std::size_t>(count));
  }
  if (descriptor >= 0) ::close(descriptor);
  return bytes;
}

// nothing when there is no such program
std::optional<Written> run_xacro(std::string const& file) {
  MemoryFile const out(""), err("");
  std::string const out_path = out.path(), err_path = err.path();
  std::array<std::string, 2> words{"xacro", file};
  std::array<char*, 3> arguments{words[0].data(), words[1].data(), nullptr};
  posix_spawn_file_actions_t actions;
  ::posix_spawn_file_actions_init(&actions);
  ::posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  ::posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, out_path.c_str(), O_WRONLY, 0);
  ::posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, err_path.c_str(), O_WRONLY, 0);
  pid_t child = 0;
  int const failure = ::posix_spawnp(&child, words[0].c_str(), &actions, nullptr, arguments.data(), environ);
  ::posix_spawn_file_actions_destroy(&actions);
  if (failure != 0) return std::nullopt;
  int status = 0;
  while (::waitpid(child, &status, 0) < 0)
    if (errno != EINTR) return Written{-1, "", ""};
  return Written{WIFEXITED(status) ? WEXITSTATUS(status) : -1, bytes_of(out), bytes_of(err)};
}

[[noreturn]] void refuse_xacro(RobotText const& text, std::string what, std::vector<std::string> notes) {
  auto const macro = text.text.find("<xacro:");
  Problem problem;
  problem.code = ExitCode::bad_data;
  problem.what = std::move(what);
  problem.place = macro == std::string::npos ? text.whole() : text.place(macro, 7);
  problem.notes = std::move(notes);
  problem.help = fmt::format(
      "write it out where ROS is (with the arguments it may need), and use that file: xacro {} > robot.urdf",
      text.file);
  throw Error(std::move(problem));
}

// the end of it, where Python says what is wrong
std::vector<std::string> last_words(std::string const& said) {
  auto const begin = said.size() > most_words_shown ? said.size() - most_words_shown : 0;
  std::vector<std::string> lines;
  for (std::size_t at = begin; at < said.size();) {
    auto const end = std::min(said.find('\n', at), said.size());
    if (end > at) lines.push_back("xacro: " + said.substr(at, end - at));
    at = end + 1;
  }
  return lines;
}

}  // namespace

RobotText urdf_of_xacro(RobotText const& text) {
  std::error_code ignored;
  // a name that begins with a dash would be an option
  auto const path = std::filesystem::absolute(text.file, ignored);
  auto const written = run_xacro(path.string());
  if (!written || written->status == 127)
    refuse_xacro(
        text,
        fmt::format("{} is a xacro, and the program xacro, which makes a URDF of it, is not installed", text.file), {});
  if (written->status != 0 || written->out.empty())
    refuse_xacro(text, fmt::format("xacro could not write {} out", text.file), last_words(written->err));
  if (written->out.size() > most_urdf_bytes)
    refuse_xacro(text, fmt::format("xacro made more than 16 MiB of {}", text.file), {});
  return {text.file + ", written out", written->out};
}

}  // namespace torquescope
