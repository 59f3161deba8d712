#pragma once
// Waits until `ready` holds, as std::condition_variable::wait does. That is a function of libstdc++ 12, and all that
// the program would need of it: without it one tarball runs where libstdc++ is 11 too (scripts/packages/README.md).
//
// Threads    as std::condition_variable; `lock` is held whenever ready() is called and at the end

#include <chrono>
#include <condition_variable>
#include <mutex>

namespace torquescope {

template <class Ready>
void wait_until_true(std::condition_variable& changed, std::unique_lock<std::mutex>& lock, Ready ready) {
  constexpr std::chrono::hours now_and_then{1};
  while (!changed.wait_for(lock, now_and_then, ready)) {
  }
}

}  // namespace torquescope
