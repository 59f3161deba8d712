#pragma once
// Calls a function again and again from a thread of its own, until it goes.
//
// Threads    `beat` runs in the other thread; the destructor waits for it

#include <chrono>
#include <condition_variable>
#include <functional>
#include <mutex>
#include <thread>

namespace torquescope {

class Heartbeat {
 public:
  Heartbeat(std::chrono::milliseconds period, std::function<void()> beat);
  ~Heartbeat();
  Heartbeat(Heartbeat const&) = delete;
  Heartbeat& operator=(Heartbeat const&) = delete;

 private:
  std::mutex guard_;
  std::condition_variable ends_;
  bool began_ = false;
  bool over_ = false;
  std::thread thread_;
};

}  // namespace torquescope
