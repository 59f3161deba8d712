#pragma once
// How long each phase of a command took, so that the phases add up to the whole.
//
// Counted    a phase lasts from its first update to the first of the next one, or to finish(): what is done between the
//            updates of two phases belongs to the earlier. A phase that comes again is added to what it was
// Before     the time before the first update is the phase "prepare"
// Units      seconds of the given clock
// Threads    one at a time

#include <functional>
#include <vector>

#include "engine/workflows/workflows.hpp"

namespace torquescope {

class PhaseTimes {
 public:
  using Clock = std::function<double()>;

  explicit PhaseTimes(Clock clock);

  void note(ProgressUpdate const& update);
  // in the order in which they came first; `seconds` are those of the phase, `runs_done` of all its turns
  std::vector<ProgressUpdate> finish();

 private:
  void close();

  Clock clock_;
  std::vector<ProgressUpdate> totals_{};
  ProgressUpdate current_{};
  double began_ = 0.0;
};

}  // namespace torquescope
