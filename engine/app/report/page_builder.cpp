#include "engine/app/report/page_builder.hpp"

#include <fmt/format.h>
#include <sys/resource.h>

#include <algorithm>
#include <cstdint>
#include <system_error>

#include "engine/app/report/child_program.hpp"
#include "engine/app/terminal/environment.hpp"
#include "engine/base/error.hpp"

namespace torquescope {

namespace {

// Of the processor. A page takes some seconds, and one of a large result the time to read it; a question is answered
// at once. Who needs more goes round in circles
constexpr int question_seconds = 30, page_seconds = 60;

int seconds_for(std::vector<std::string> const& files) {
  std::uintmax_t bytes = 0;
  for (auto const& file : files) {
    std::error_code unknown;
    auto const size = std::filesystem::file_size(file, unknown);
    if (!unknown) bytes += size;
  }
  constexpr std::uintmax_t most_seconds = 86'400;
  return page_seconds + static_cast<int>(std::min(bytes >> 20, most_seconds));  // a second for each MiB
}

// Of address space: a page of a small study takes 292 MB with numpy, matplotlib and OpenBLAS on one thread. With less
// OpenBLAS asks again and again, and never ends
constexpr rlim_t least_address_space = 295'000'000;

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

void require_address_space() {
  rlimit limit{};
  if (::getrlimit(RLIMIT_AS, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY || limit.rlim_cur >= least_address_space)
    return;
  throw page_problem(ExitCode::internal,
                     fmt::format("a page needs {} MB of address space, and this process may have {}",
                                 least_address_space / 1'000'000, limit.rlim_cur / 1'000'000),
                     "make the page where memory is not limited (ulimit -v, a batch system); the result files "
                     "themselves are unharmed");
}

std::string find_python() {
  std::optional<int> missing;
  for (char const* const python : {"/usr/bin/python3", "python3"}) {
    auto const status = run_program({python, "-c", question}, Voice::silent, question_seconds).status;
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
  require_address_space();
  std::string const python = find_python();
  std::vector<std::string> arguments{python, program->string(), "--out=" + page.string(), "--"};
  arguments.insert(arguments.end(), files.begin(), files.end());
  ProgramEnd const end = run_program(std::move(arguments), Voice::heard, seconds_for(files));
  if (end.used_up_its_time)
    throw page_problem(
        ExitCode::internal, "the page builder used up its time and was stopped",
        "is memory limited (ulimit -v, a batch system)? numpy wants up to half a gigabyte of address space; "
        "the result files themselves are unharmed");
  auto const status = end.status;
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
