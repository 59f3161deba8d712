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
    Problem problem = problem_at(section_or_empty(parts.job, "recording"), "train",
                                 "a diagnosis is made of one training recording",
                                 "name one in train, the others in validate");
    return problem;
  });
  return recordings.front();
}

StageSink told_as_progress(ProgressSink const& progress, DiagnoseRequest const& request) {
  using Clock = std::chrono::steady_clock;
  auto const start = Clock::now();
  return [&progress, &request, start](std::string const& stage, std::size_t done, std::size_t total) {
    if (request.stop_requested && request.stop_requested())
      throw Error(Problem{ExitCode::stopped, "stopped: nothing was written"});
    if (!progress) return;
    ProgressUpdate update;
    update.stage = stage;
    update.counted = "effects";
    update.runs_done = static_cast<std::int64_t>(done);
    update.runs_total = static_cast<std::int64_t>(total);
    update.seconds = std::chrono::duration<double>(Clock::now() - start).count();
    progress(update);
  };
}

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
  input.twins = static_cast<std::size_t>(parts.diagnose.twins);
  input.seed = static_cast<std::uint64_t>(parts.experiment.seed);
  input.threads = request.threads.count;
  StageSink const sink = told_as_progress(progress, request);
  return diagnose_into_file(experiment, request, [&] { return diagnose_joint(input, sink); });
}

}  // namespace torquescope
