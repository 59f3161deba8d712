#include "engine/app/terminal/interrupt.hpp"

#include <fmt/format.h>
#include <signal.h>  // NOLINT(modernize-deprecated-headers): sigaction is POSIX, <csignal> does not promise it
#include <time.h>    // NOLINT(modernize-deprecated-headers): clock_gettime is POSIX, <ctime> does not promise it
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <limits>
#include <string_view>

#include "engine/store/shard_lock.hpp"

namespace torquescope {

namespace {

constexpr unsigned seconds_to_stop = 4;
constexpr int stopped = 75;  // ExitCode::stopped

// lock-free, so that a signal handler may touch them
std::atomic<int> first_signal{0};
std::atomic<int> interrupts_seen{0};
std::atomic<bool> notice_spoken{false};
std::atomic<char const*> words_at_first{words_of_runs.at_first}, words_cut_short{words_of_runs.cut_short};
std::atomic<bool> saving{false};
std::atomic<double> budget_s{0.0};
std::atomic<double> stop_at_s{std::numeric_limits<double>::infinity()};
static_assert(std::atomic<int>::is_always_lock_free && std::atomic<char const*>::is_always_lock_free);

double clock_s(clockid_t clock) {
  timespec now{};
  ::clock_gettime(clock, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

double const process_began_s = clock_s(CLOCK_MONOTONIC);

char const* name_of(int number) {
  switch (number) {
    case SIGINT:
      return "Ctrl-C (SIGINT)";
    case SIGTERM:
      return "SIGTERM";
    case SIGUSR1:
      return "SIGUSR1";
    case SIGXCPU:
      return "SIGXCPU (limit of processor time)";
    default:
      return "SIGHUP (its terminal went away)";
  }
}

void say(std::string_view text) {
  [[maybe_unused]] auto const written = ::write(STDERR_FILENO, text.data(), text.size());
}

[[noreturn]] void end_by_force(int code) {
  drop_held_lock();
  ::_exit(code);
}

void on_stop_signal(int number) {
  int const saved_errno = errno;
  if (number == SIGINT && interrupts_seen.fetch_add(1) > 0) end_by_force(128 + number);
  int none = 0;
  if (first_signal.compare_exchange_strong(none, number)) {
    if (notice_spoken.load())
      for (char const* part : {"\n", words_at_first.load(), " (Ctrl-C to stop at once)\n"}) say(part);
    if (!saving.load()) ::alarm(seconds_to_stop);
  }
  errno = saved_errno;
}

void on_alarm(int) {
  for (char const* part : {"\n", name_of(first_signal.load()), ": ", words_cut_short.load(), "\n"}) say(part);
  end_by_force(stopped);
}

}  // namespace

void install_stop_signals(StopNotice notice, StopWords const& words) {
  words_at_first.store(words.at_first);
  words_cut_short.store(words.cut_short);
  notice_spoken.store(notice == StopNotice::spoken);
  struct sigaction action {};
  action.sa_handler = on_stop_signal;
  action.sa_flags = SA_RESTART;
  ::sigemptyset(&action.sa_mask);
  for (int const number : {SIGINT, SIGTERM, SIGUSR1, SIGXCPU, SIGHUP}) {
    // nohup and background shells ignore some signals for us: that stays
    struct sigaction inherited {};
    ::sigaction(number, nullptr, &inherited);
    if (inherited.sa_handler != SIG_IGN) ::sigaction(number, &action, nullptr);
  }
  action.sa_handler = on_alarm;
  ::sigaction(SIGALRM, &action, nullptr);
}

void ignore_write_signals() {
  for (int const number : {SIGPIPE, SIGXFSZ}) ::signal(number, SIG_IGN);
}

void stop_after(double seconds) {
  constexpr double share_to_save = 0.1, most_to_save_s = 60.0;
  budget_s.store(seconds);
  stop_at_s.store(process_began_s + seconds - std::min(share_to_save * seconds, most_to_save_s));
}

bool stop_requested() {
  return first_signal.load(std::memory_order_relaxed) != 0 ||
         clock_s(CLOCK_MONOTONIC_COARSE) >= stop_at_s.load(std::memory_order_relaxed);
}

std::string stop_words() {
  int const number = first_signal.load();
  return number != 0 ? name_of(number) : fmt::format("time budget ({:g} s)", budget_s.load());
}

void saving_begins() {
  saving.store(true);
  ::alarm(0);
}

}  // namespace torquescope
