#pragma once
// How far a stage of a run or a diagnosis is. Apart from workflows.hpp, so that a terminal reads no matrices.

#include <cstdint>
#include <functional>
#include <string>

namespace torquescope {

// told from worker threads, one call at a time
struct ProgressUpdate {
  std::string stage;  // estimator's name
  std::int64_t runs_done = 0, runs_total = 0;
  std::int64_t evaluations_done = 0, evaluations_total = 0;
  double seconds = 0.0;           // since the stage began
  std::string counted = "runs";   // what is counted as runs: "replicates", "effects"
  double expected_seconds = 0.0;  // of all stages together, as estimated before they began; 0: nobody did
};
using ProgressSink = std::function<void(ProgressUpdate const&)>;

}  // namespace torquescope
