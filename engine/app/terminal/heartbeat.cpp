#include "engine/app/terminal/heartbeat.hpp"

#include <csignal>
#include <utility>

#include "engine/base/fork_guard.hpp"
#include "engine/base/wait_until_true.hpp"

namespace torquescope {

namespace {

// signals stay with the thread that works: they are to wake what it waits for
std::thread started_without_signals(std::function<void()> work) {
  sigset_t all, before;
  sigfillset(&all);
  pthread_sigmask(SIG_SETMASK, &all, &before);
  std::thread thread(std::move(work));
  pthread_sigmask(SIG_SETMASK, &before, nullptr);
  return thread;
}

}  // namespace

Heartbeat::Heartbeat(std::chrono::milliseconds period, std::function<void()> beat)
    : thread_(started_without_signals([this, period, beat = std::move(beat)] {
        std::unique_lock lock(guard_);
        began_ = true;
        ends_.notify_one();
        while (!ends_.wait_for(lock, period, [this] { return over_; })) {
          std::lock_guard const nobody_forks(fork_guard());
          beat();
        }
      })) {
  // a thread that begins takes locks too, which a fork must not meet (fork_guard.hpp)
  std::unique_lock lock(guard_);
  wait_until_true(ends_, lock, [this] { return began_; });
}

Heartbeat::~Heartbeat() {
  {
    std::lock_guard const lock(guard_);
    over_ = true;
  }
  ends_.notify_one();
  thread_.join();
}

}  // namespace torquescope
