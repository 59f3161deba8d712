#pragma once
// Tells a ProgressSink how far one estimator is: at most once per finished run and some times a second between.
//
// Threads    any

#include <atomic>
#include <chrono>
#include <cstdint>
#include <mutex>
#include <string>

#include "engine/experiment/progress_update.hpp"

namespace torquescope {

class StageProgress {
 public:
  StageProgress(ProgressSink const& sink, std::string stage, std::int64_t runs, std::int64_t evaluations);

  void count_evaluations(std::int64_t evaluations);
  void count_run();

 private:
  using Clock = std::chrono::steady_clock;
  void tell();

  ProgressSink const& sink_;
  Clock::time_point start_;
  Clock::time_point last_{};
  std::mutex guard_;
  std::atomic<std::int64_t> evaluations_{0};
  ProgressUpdate update_;
};

}  // namespace torquescope
