#pragma once
// `torquescope diagnose` of a job with [[recordings]]: which effects of drive and gear all of them need.
//
// Errors     those of the job and its files; 75 when it is stopped; 73 where another result stands
// Threads    spreads fits over request.threads; call it from one thread

#include <array>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "engine/experiment/progress_update.hpp"
#include "engine/experiment/runs/provenance_writer.hpp"
#include "engine/experiment/servo_job.hpp"
#include "engine/workflows/servo_report.hpp"
#include "engine/workflows/workflows.hpp"

namespace torquescope {

struct ServoRequest {
  ThreadChoice threads{};
  std::filesystem::path output{};
  std::vector<std::string> leave_out{};  // quantities: fits without each value of them in turn
  std::function<bool()> stop_requested{};
};

ServoReport diagnose_servo(ServoJob const& job, ServoRequest const& request, ProgressSink const& progress);

// what a set of recordings is, and what it cannot tell
std::vector<CheckLine> check_servo(ServoJob const& job);
std::vector<ServoRemark> notes_of(ServoJob const& job);

// Error 73 where something else stands than an earlier diagnosis of a set: before it is simulated, and as it is written
void refuse_other_result(std::filesystem::path const& output);
// a result with /job, /servo and /replay (store/RESULT_FORMAT.md); printed: the verdict and the rest, for `show`
void write_servo_file(ServoJob const& job, ServoReport const& report, ServoRequest const& request,
                      std::array<std::string, 2> const& printed, Beginning const& beginning);
std::string servo_json(ServoReport const& report);

}  // namespace torquescope
