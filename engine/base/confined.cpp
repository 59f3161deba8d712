#include "engine/base/confined.hpp"

#include <fcntl.h>
#include <signal.h>  // NOLINT(modernize-deprecated-headers): SIGXCPU is POSIX, <csignal> does not promise it
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <mutex>
#include <new>
#include <system_error>

#include "engine/base/fork_guard.hpp"
#include "engine/base/packed_bytes.hpp"

namespace torquescope {
namespace {

#if defined(__has_feature)
#define TORQUESCOPE_HAS_FEATURE(feature) __has_feature(feature)
#else
#define TORQUESCOPE_HAS_FEATURE(feature) 0
#endif
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__) || TORQUESCOPE_HAS_FEATURE(address_sanitizer) || \
    TORQUESCOPE_HAS_FEATURE(thread_sanitizer)
constexpr bool under_sanitizer = true;
#else
constexpr bool under_sanitizer = false;
#endif

// how a child's work ended, and its first byte on the pipe
constexpr char done = 'd', refused = 'r', no_memory = 'm', failed = 'f';

void pack_problem(PackedWriter& out, Problem const& problem) {
  auto const& place = problem.place;
  out.whole(static_cast<int>(problem.code)).text(problem.what);
  out.text(place.file).whole(place.line).whole(place.column).whole(place.length).text(place.line_text);
  out.text(problem.key).texts(problem.notes).text(problem.caret_note).text(problem.help);
}

Problem unpack_problem(PackedReader& in) {
  Problem problem;
  problem.code = static_cast<ExitCode>(in.whole());
  problem.what = in.text();
  problem.place.file = in.text();
  problem.place.line = static_cast<int>(in.whole());
  problem.place.column = static_cast<int>(in.whole());
  problem.place.length = static_cast<int>(in.whole());
  problem.place.line_text = in.text();
  problem.key = in.text();
  problem.notes = in.texts();
  problem.caret_note = in.text();
  problem.help = in.text();
  return problem;
}

std::uint64_t memory_in_use() {
  std::FILE* const file = std::fopen("/proc/self/statm", "re");
  unsigned long pages = 0;
  bool const known = file != nullptr && std::fscanf(file, "%lu", &pages) == 1;
  if (file != nullptr) std::fclose(file);
  return known ? pages * static_cast<std::uint64_t>(::sysconf(_SC_PAGESIZE)) : 0;
}

void set_limit(decltype(RLIMIT_CPU) kind, std::uint64_t value) {
  rlimit limit{};
  if (::getrlimit(kind, &limit) != 0) return;
  limit.rlim_cur = std::min<rlim_t>(value, limit.rlim_max);
  ::setrlimit(kind, &limit);
}

void confine(ConfinedLimits const& limits) {
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  // the parent decides what an interrupt means; SIGXCPU ends the child
  for (int number : {SIGINT, SIGTERM, SIGHUP, SIGUSR1}) ::signal(number, SIG_IGN);
  for (int number : {SIGXCPU, SIGSEGV, SIGBUS, SIGFPE, SIGABRT, SIGILL})
    if (!under_sanitizer || number == SIGXCPU) ::signal(number, SIG_DFL);
  set_limit(RLIMIT_CPU, static_cast<std::uint64_t>(limits.processor_seconds));  // a new process begins at zero
  set_limit(RLIMIT_CORE, 0);
  if (under_sanitizer) return;  // it reserves all memory there is, and what it reports must be seen
  set_limit(RLIMIT_AS, memory_in_use() + limits.more_memory_bytes);
  int const nowhere = ::open("/dev/null", O_WRONLY | O_CLOEXEC);
  if (nowhere >= 0) ::dup2(nowhere, STDERR_FILENO);  // "free(): invalid pointer" helps nobody
}

bool write_all(int descriptor, std::string_view bytes) {
  while (!bytes.empty()) {
    auto const count = ::write(descriptor, bytes.data(), bytes.size());
    if (count < 0 && errno != EINTR) return false;
    if (count > 0) bytes.remove_prefix(static_cast<std::size_t>(count));
  }
  return true;
}

bool send(int descriptor, char how, std::string_view bytes) {
  return write_all(descriptor, std::string_view(&how, 1)) && write_all(descriptor, bytes);
}

[[noreturn]] void be_the_child(int descriptor, std::function<std::string()> const& work, ConfinedLimits const& limits) {
  bool sent = false;
  try {
    confine(limits);
    sent = send(descriptor, done, work());
  } catch (Error const& error) {
    PackedWriter out;
    out.whole(static_cast<std::int64_t>(error.problems().size()));
    for (auto const& problem : error.problems()) pack_problem(out, problem);
    sent = send(descriptor, refused, std::move(out).take());
  } catch (std::bad_alloc const&) {
    sent = send(descriptor, no_memory, {});
  } catch (std::exception const& other) {
    sent = send(descriptor, failed, other.what());
  }
  ::_exit(sent ? 0 : 1);
}

std::string read_to_end(int descriptor) {
  constexpr std::size_t block = std::size_t{1} << 20;
  std::string bytes;
  while (true) {
    std::size_t const before = bytes.size();
    if (bytes.capacity() < before + block) bytes.reserve(before + before / 2 + block);
    bytes.resize(before + block);
    auto const count = ::read(descriptor, bytes.data() + before, block);
    bytes.resize(before + (count > 0 ? static_cast<std::size_t>(count) : 0));
    if (count == 0 || (count < 0 && errno != EINTR)) return bytes;
  }
}

int wait_for(pid_t child) {
  int status = 0;
  while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  return status;
}

[[noreturn]] void rethrow(std::string_view packed) {
  PackedReader in(packed);
  std::vector<Problem> problems;
  for (std::size_t n = in.count(); n > 0; --n) problems.push_back(unpack_problem(in));
  throw Error(std::move(problems));
}

std::string how_it_ended(int status, ConfinedLimits const& limits) {
  if (!WIFSIGNALED(status)) return "ended early";
  int const number = WTERMSIG(status);
  if (number == SIGXCPU) return "took longer than " + std::to_string(limits.processor_seconds) + " s";
  if (number == SIGKILL) return "was killed (out of memory?)";
  return "crashed (signal " + std::to_string(number) + ")";
}

Error no_child(char const* what) {
  Problem problem;
  problem.code = ExitCode::io;
  problem.what = std::string("cannot start a process to read a file in: ") + what + ": " + std::strerror(errno);
  problem.help = "is the number of processes limited here? (ulimit -u)";
  return Error(std::move(problem));
}

}  // namespace

ConfinedLimits limits_for_file(std::filesystem::path const& file, int least_seconds) {
  constexpr std::uintmax_t bytes_per_second = std::uintmax_t{2} << 20, most_seconds = 1000000;
  std::error_code unknown;
  auto const bytes = std::filesystem::file_size(file, unknown);
  ConfinedLimits limits{.processor_seconds = least_seconds};
  if (!unknown) limits.processor_seconds += static_cast<int>(std::min(bytes / bytes_per_second, most_seconds));
  return limits;
}

std::string run_confined(std::function<std::string()> const& work, ConfinedLimits const& limits,
                         std::function<Problem(std::string const& how)> const& broke_off) {
  int ends[2] = {-1, -1};
  if (::pipe2(ends, O_CLOEXEC) != 0) throw no_child("pipe");
  std::unique_lock nobody_works(fork_guard());
  pid_t const child = ::fork();
  if (child == 0) {
    nobody_works.unlock();
    ::close(ends[0]);
    be_the_child(ends[1], work, limits);
  }
  nobody_works.unlock();
  ::close(ends[1]);
  if (child < 0) {
    ::close(ends[0]);
    throw no_child("fork");
  }
  std::string bytes = read_to_end(ends[0]);
  ::close(ends[0]);
  int const status = wait_for(child);
  if (status != 0 || bytes.empty()) throw Error(broke_off(how_it_ended(status, limits)));
  char const how = bytes.front();
  if (how == no_memory) throw Error(broke_off("ran out of memory"));
  if (how == refused) rethrow(std::string_view(bytes).substr(1));
  if (how == failed) throw Error(broke_off("failed: " + bytes.substr(1)));
  bytes.erase(0, 1);
  return bytes;
}

}  // namespace torquescope
