#pragma once
// Who forks while other threads run leaves the child every lock that they hold at that instant, for ever.
//
// Held       by whoever forks (run_confined), across the fork; by a thread of its own (Heartbeat), while it works: it
//            then holds no lock of an allocator or a stream that the child would wait for
// Source     POSIX.1-2017, fork(), Rationale
// Threads    any

#include <mutex>

namespace torquescope {

inline std::mutex& fork_guard() {
  static std::mutex guard;
  return guard;
}

}  // namespace torquescope
