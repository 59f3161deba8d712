#pragma once
// `torquescope diagnose` of a job with [[recordings]]: which laws of drive and gear all of them need.
//
// Errors     those of the job and its files; 75 when it is stopped; 73 where another result stands
// Threads    spreads fits over request.threads; call it from one thread

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "engine/run/progress_update.hpp"
#include "engine/run/servo_job.hpp"
#include "engine/run/servo_report.hpp"

namespace torquescope {

struct ServoRequest {
  ThreadChoice threads{};
  std::filesystem::path output{};
  std::vector<std::string> leave_out{};  // quantities: fits without each value of them in turn
  std::function<bool()> stop_requested{};
};

ServoReport diagnose_servo(ServoJob const& job, ServoRequest const& request, ProgressSink const& progress);

// a result with /job, /servo and /replay (store/RESULT_FORMAT.md)
void write_servo_file(ServoJob const& job, ServoReport const& report, ServoRequest const& request);
std::string servo_json(ServoReport const& report);

}  // namespace torquescope
