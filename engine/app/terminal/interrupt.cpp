#include "engine/app/terminal/interrupt.hpp"

#include <signal.h>  // NOLINT(modernize-deprecated-headers): sigaction is POSIX, <csignal> does not promise it
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <string_view>

namespace torquescope {

namespace {

// lock-free, so that a signal handler may touch them
std::atomic<int> signals_seen{0};
std::atomic<bool> notice_spoken{false};
static_assert(std::atomic<int>::is_always_lock_free);

void on_stop_signal(int number) {
  int const saved_errno = errno;
  if (signals_seen.fetch_add(1) > 0) ::_exit(128 + number);
  if (notice_spoken.load()) {
    constexpr std::string_view notice = "\nstopping after the running generation (again to stop at once)\n";
    [[maybe_unused]] auto const written = ::write(STDERR_FILENO, notice.data(), notice.size());
  }
  errno = saved_errno;
}

}  // namespace

void install_stop_signals(StopNotice notice) {
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
}

void ignore_write_signals() {
  for (int const number : {SIGPIPE, SIGXFSZ}) ::signal(number, SIG_IGN);
}

bool stop_requested() { return signals_seen.load(std::memory_order_relaxed) > 0; }

}  // namespace torquescope
