#include "engine/app/report/page_builder.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>

#include "engine/app/terminal/environment.hpp"
#include "engine/base/error.hpp"

extern char** environ;

namespace torquescope {

namespace {

enum class Voice { heard, silent };

// exit status of a program that was waited for; nothing when it could not be started or died of a signal
std::optional<int> run_program(std::vector<std::string> arguments, Voice voice) {
  std::vector<char*> pointers;
  for (auto& argument : arguments) pointers.push_back(argument.data());
  pointers.push_back(nullptr);

  posix_spawn_file_actions_t actions;
  ::posix_spawn_file_actions_init(&actions);
  if (voice == Voice::silent) {
    ::posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
    ::posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
  } else {
    // stdout belongs to the path of the page
    ::posix_spawn_file_actions_adddup2(&actions, STDERR_FILENO, STDOUT_FILENO);
  }
  pid_t child = 0;
  int const failure = ::posix_spawnp(&child, pointers[0], &actions, nullptr, pointers.data(), environ);
  ::posix_spawn_file_actions_destroy(&actions);
  if (failure != 0) return std::nullopt;

  int status = 0;
  while (::waitpid(child, &status, 0) < 0)
    if (errno != EINTR) return std::nullopt;
  if (!WIFEXITED(status)) return std::nullopt;
  return WEXITSTATUS(status);
}

Error page_problem(ExitCode code, std::string what, std::string help) {
  Problem problem;
  problem.code = code;
  problem.what = std::move(what);
  problem.help = std::move(help);
  return Error(problem);
}

// the packages the page needs; their bits make up the exit status of the question below
constexpr char const* question =
    "import importlib.util as u, sys\n"
    "names = ('h5py', 'numpy', 'matplotlib', 'jinja2')\n"
    "sys.exit(sum(1 << i for i, n in enumerate(names) if u.find_spec(n) is None))\n";

std::string find_python() {
  std::optional<int> missing;
  for (char const* const python : {"/usr/bin/python3", "python3"}) {
    auto const status = run_program({python, "-c", question}, Voice::silent);
    if (status == 0) return python;
    if (status && *status != 127 && !missing) missing = status;
  }
  if (!missing)
    throw page_problem(ExitCode::internal, "the page needs python3, and there is none",
                       "apt install python3-h5py python3-matplotlib python3-jinja2");
  std::string packages;
  char const* const names[] = {"python3-h5py", "python3-numpy", "python3-matplotlib", "python3-jinja2"};
  for (int i = 0; i < 4; ++i)
    if (*missing & (1 << i)) packages += std::string(packages.empty() ? "" : " ") + names[i];
  throw page_problem(ExitCode::internal, "the page needs Python packages that are missing: " + packages,
                     "apt install " + packages);
}

std::filesystem::path executable_path() {
  std::error_code ignored;
  return std::filesystem::read_symlink("/proc/self/exe", ignored);
}

// `files` are what the program NAME makes the page of; `about` begins the sentence when they are at fault
void run_page_program(std::string const& name, std::vector<std::string> const& files, std::filesystem::path const& page,
                      std::string const& about) {
  auto const program = find_page_program(environment("TORQUESCOPE_SHARE"), executable_path(), name);
  if (!program)
    throw page_problem(ExitCode::no_input, "the page builder report/" + name + " is not installed beside this program",
                       "set TORQUESCOPE_SHARE to the folder that holds report/" + name);
  std::string const python = find_python();
  std::vector<std::string> arguments{python, program->string(), "--out=" + page.string(), "--"};
  arguments.insert(arguments.end(), files.begin(), files.end());
  auto const status = run_program(std::move(arguments), Voice::heard);
  if (status == static_cast<int>(ExitCode::bad_data))
    throw page_problem(ExitCode::bad_data, about + " to build a page from",
                       "the page builder's words stand above; torquescope show --verify says more");
  if (status != 0)
    throw page_problem(ExitCode::internal, fmt::format("the page builder failed ({} {})", python, program->string()),
                       "its own words stand above; the result files themselves are unharmed");
}

}  // namespace

std::optional<std::filesystem::path> find_page_program(std::string const& share_variable,
                                                       std::filesystem::path const& executable,
                                                       std::string const& name) {
  std::vector<std::filesystem::path> folders;
  if (!share_variable.empty()) folders.emplace_back(share_variable);
  folders.push_back(executable.parent_path().parent_path() / "share" / "torquescope");
  // a build folder lies somewhere inside the source tree
  for (auto folder = executable.parent_path(); folder.has_relative_path(); folder = folder.parent_path())
    folders.push_back(folder);
  for (auto const& folder : folders)
    for (char const* place : {"scripts/report", "report"}) {
      std::error_code ignored;
      if (std::filesystem::is_regular_file(folder / place / name, ignored)) return folder / place / name;
    }
  return std::nullopt;
}

void build_page(std::filesystem::path const& result, std::filesystem::path const& page) {
  run_page_program("build.py", {result.string()}, page, result.string() + " is no file");
}

void build_comparison(std::span<std::string const> results, std::filesystem::path const& page) {
  run_page_program("compare.py", {results.begin(), results.end()}, page, "one of the files is none");
}

}  // namespace torquescope
