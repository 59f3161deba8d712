// `torquescope replay`: every recording of a job or a result beside its simulation.

#include <fmt/format.h>

#include <algorithm>

#include "engine/base/error.hpp"
#include "engine/data/file_bytes.hpp"
#include "engine/experiment/experiment_parts.hpp"
#include "engine/experiment/job_sections.hpp"
#include "engine/experiment/stored_objects.hpp"
#include "engine/store/h5.hpp"
#include "engine/store/look_at_result.hpp"
#include "engine/workflows/replay_workflow.hpp"
#include "engine/workflows/results/diagnosis_reader.hpp"

namespace torquescope {

namespace {

Problem arm_problem(std::string const& source) {
  Problem problem{ExitCode::bad_job, source + " is of an arm: rollouts simulate one joint"};
  problem.help = "name one joint's columns in a job with model.terms, or export the arm (torquescope export)";
  return problem;
}

// what a result says the model's numbers are
struct StoredModels {
  std::string job_text, job_sha256;
  std::vector<std::string> names;  // of /model
  struct Estimate {
    std::string label;
    std::vector<double> parameters;
  };
  std::vector<Estimate> estimates;  // of the runs; the median run of each
  std::optional<Diagnosis> diagnosis{};
};

std::vector<double> median_run(StoredObjects const& in, std::string const& group, std::size_t parameters) {
  auto const numbers = in.numbers(group + "/parameters"), gaps = in.numbers(group + "/gap");
  if (parameters == 0 || numbers.size() < parameters) return {};
  std::vector<double> sorted(gaps);
  std::size_t run = 0;
  if (gaps.size() * parameters == numbers.size() && !gaps.empty()) {
    std::sort(sorted.begin(), sorted.end());
    double const middle = sorted[(sorted.size() - 1) / 2];
    run = static_cast<std::size_t>(std::find(gaps.begin(), gaps.end(), middle) - gaps.begin()) % gaps.size();
  }
  auto const from = numbers.begin() + static_cast<std::ptrdiff_t>(run * parameters);
  return {from, from + static_cast<std::ptrdiff_t>(parameters)};
}

StoredModels stored_models(std::filesystem::path const& file) {
  look_at_result(file, [](ResultReader const& there) { static_cast<void>(there); });
  ResultReader const reader(file);
  StoredObjects const in(reader);
  StoredModels stored;
  auto const text = in.text_column("/job/text");
  validate(!text.empty(), [&] {
    return Problem{.code = ExitCode::bad_data,
                   .what = file.string() + " holds no job to replay",
                   .help = "replay takes a job, or a result of run or diagnose"};
  });
  stored.job_text = text.front();
  stored.job_sha256 = in.text("/job", "sha256");
  validate(in.text("/model", "joint") != "arm", [&] { return arm_problem(file.string()); });
  stored.names = in.text_column("/model/names");
  if (has_diagnosis(reader)) stored.diagnosis = read_diagnosis(reader);
  if (reader.exists("/runs"))
    for (auto const& label : in.texts("/runs", "order"))
      stored.estimates.push_back({label, median_run(in, "/runs/" + label, stored.names.size())});
  return stored;
}

Job job_of_result(StoredModels const& stored, ReplayRequest const& request) {
  if (request.job.empty()) return parse_job(stored.job_text, request.source.filename().replace_extension(".toml"));
  Job job = read_job(request.job);
  validate(job.sha256 == stored.job_sha256, [&] {
    Problem problem{ExitCode::bad_job,
                    fmt::format("{} is not the job that made {}", request.job.string(), request.source.string())};
    problem.help = "name the job file as it was then, or replay the job itself";
    return problem;
  });
  return job;
}

// a result knows its job's text, not where the job stood
void require_recordings_here(Job const& job, std::filesystem::path const& result) {
  std::vector<Problem> ignored;
  auto const recording = read_options<RecordingOptions>(job, ignored);
  std::error_code unknown;
  for (auto const* files : {&recording.train, &recording.validate})
    for (auto const& file : *files)
      validate(std::filesystem::exists(job.resolve(file), unknown), [&] {
        Problem problem{ExitCode::no_input, fmt::format("{} is made of {}, which is not here", result.string(), file)};
        problem.help = "--job JOB.toml says where the paths of its recordings begin";
        return problem;
      });
}

// other recordings in place of the job's validation
void with_recordings(Job& job, std::vector<std::string> const& recordings) {
  if (recordings.empty()) return;
  for (auto& section : job.sections) {
    if (section.name != "recording") continue;
    std::erase_if(section.settings, [](Setting const& one) { return one.key == "validate"; });
    std::vector<std::string> absolute;
    for (auto const& one : recordings) absolute.push_back(std::filesystem::absolute(one).string());
    section.settings.push_back({"validate", absolute, section.place, section.place});
    return;
  }
  Problem problem{ExitCode::usage, "the job simulates its recordings: no others can be named"};
  problem.help = "leave the recordings out";
  throw Error(problem);
}

bool is_result_file(std::filesystem::path const& path) { return h5::is_hdf5(ReadFile(path)); }

}  // namespace

Experiment load_for_replay(ReplayRequest const& request, std::vector<ReplaySource>& sources) {
  bool const is_result = is_result_file(request.source);
  std::optional<StoredModels> stored;
  if (is_result) stored = stored_models(request.source);
  Job job = stored ? job_of_result(*stored, request) : read_job(request.source);
  with_recordings(job, request.recordings);
  if (stored && request.job.empty()) require_recordings_here(job, request.source);
  Experiment experiment = Experiment::load(std::move(job), Experiment::Purpose::replay);
  validate(experiment.parts().rollout.has_value(), [&] { return arm_problem(request.source.string()); });
  if (!stored) {
    sources = sources_of_job(experiment.parts(), *experiment.parts().rollout);
  } else if (stored->diagnosis) {
    sources = sources_of_diagnosis(experiment.parts(), *experiment.parts().rollout, *stored->diagnosis);
  } else {
    for (auto const& estimate : stored->estimates)
      if (request.estimator.empty() || estimate.label == request.estimator)
        add_source_of_run(experiment.parts(), *experiment.parts().rollout, estimate.label, stored->names,
                          estimate.parameters, sources);
  }
  validate(!sources.empty(), [&] {
    Problem problem{ExitCode::bad_data, request.source.string() + " holds no parameters of a joint"};
    problem.help = request.estimator.empty() ? "run the job first, or replay the job file itself"
                                             : fmt::format("no estimator \"{}\" there", request.estimator);
    return problem;
  });
  return experiment;
}

}  // namespace torquescope
