// `torquescope diagnose`: from a loaded job to a verdict in a result file.

#include <chrono>

#include "engine/diagnose/joint_diagnosis.hpp"
#include "engine/run/diagnosis_result.hpp"
#include "engine/run/experiment_parts.hpp"
#include "engine/run/job_sections.hpp"

namespace torquescope {

namespace {

// a diagnosis compares one recording with its twins; more of them are for `run`
Recording const& training_recording(Experiment::Parts const& parts) {
  auto const& recordings = parts.train.recordings;
  validate(recordings.size() == 1, [&] {
    Problem problem =
        problem_at(section_or_empty(parts.job, "recording"), "train", "a diagnosis is made of one training recording",
                   "name one in train, the others in validate");
    return problem;
  });
  return recordings.front();
}

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
  auto const& parts = experiment.parts();
  Recording const& train = training_recording(parts);
  Section const filter = section_or_empty(parts.job, "filter");
  std::vector<Recording> const none;
  DiagnosisInput input{train, parts.validate ? parts.validate->recordings : none, *parts.regressor, parts.filter,
                       filter};
  input.selection.candidates = parts.effects;
  input.selection.q = parts.diagnose.q;
  input.selection.max_effects = static_cast<std::size_t>(parts.diagnose.max_effects);
  input.selection.shape_optimiser = parts.diagnose.shape_optimiser;
  input.twins = static_cast<std::size_t>(parts.diagnose.twins);
  input.seed = static_cast<std::uint64_t>(parts.experiment.seed);
  input.threads = request.threads.count;
  Stages stages(progress, request);
  StageSink const sink = [&stages](std::string const& stage, std::size_t done, std::size_t total) {
    stages(stage, done, total);
  };
  return diagnose_into_file(experiment, request, [&] { return diagnose_joint(input, sink); });
}

}  // namespace torquescope
