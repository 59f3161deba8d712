#include "engine/experiment/runs/stage_progress.hpp"

#include <utility>

namespace torquescope {

StageProgress::StageProgress(ProgressSink const& sink, std::string stage, std::int64_t runs, std::int64_t evaluations)
    : sink_(sink), start_(Clock::now()) {
  update_.stage = std::move(stage);
  update_.runs_total = runs;
  update_.evaluations_total = evaluations;
  tell();
}

void StageProgress::count_evaluations(std::int64_t evaluations) {
  evaluations_.fetch_add(evaluations, std::memory_order_relaxed);
  // a thread that finds the sink busy leaves the news to the next one
  std::unique_lock const lock(guard_, std::try_to_lock);
  if (lock.owns_lock() && std::chrono::duration<double>(Clock::now() - last_).count() > 0.05) tell();
}

void StageProgress::count_run() {
  std::lock_guard const lock(guard_);
  ++update_.runs_done;
  tell();
}

void StageProgress::tell() {
  last_ = Clock::now();
  update_.evaluations_done = evaluations_.load(std::memory_order_relaxed);
  update_.seconds = std::chrono::duration<double>(last_ - start_).count();
  if (sink_) sink_(update_);
}

}  // namespace torquescope
