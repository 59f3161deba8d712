// `torquescope diagnose`: from a loaded job to a verdict in a result file.

#include <chrono>

#include "engine/run/diagnosis_input.hpp"
#include "engine/run/diagnosis_result.hpp"
#include "engine/run/disk_room.hpp"

namespace torquescope {

namespace {

// seconds of an update count from the stage's beginning
class Stages {
 public:
  Stages(ProgressSink const& progress, DiagnoseRequest const& request) : progress_(progress), request_(request) {}

  void operator()(std::string const& stage, std::size_t done, std::size_t total) {
    if (request_.stop_requested && request_.stop_requested())
      throw Error(Problem{ExitCode::stopped, "stopped: nothing was written"});
    if (stage != stage_) start_ = Clock::now();
    stage_ = stage;
    if (!progress_) return;
    ProgressUpdate update;
    update.stage = stage;
    update.counted = stage == "twins" ? "clean twins" : "effects";
    update.runs_done = static_cast<std::int64_t>(done);
    update.runs_total = static_cast<std::int64_t>(total);
    update.seconds = std::chrono::duration<double>(Clock::now() - start_).count();
    progress_(update);
  }

 private:
  using Clock = std::chrono::steady_clock;
  ProgressSink const& progress_;
  DiagnoseRequest const& request_;
  std::string stage_;
  Clock::time_point start_{};
};

}  // namespace

Diagnosis diagnose(Experiment const& experiment, DiagnoseRequest const& request, ProgressSink const& progress) {
  check_room(request, diagnosis_bytes(experiment.parts()));
  JobInput const job(experiment.parts(), request.threads.count);
  Stages stages(progress, request);
  StageSink const sink = [&stages](std::string const& stage, std::size_t done, std::size_t total) {
    stages(stage, done, total);
  };
  return diagnose_into_file(experiment, request, [&] { return diagnose_joint(job.input(), sink); });
}

}  // namespace torquescope
