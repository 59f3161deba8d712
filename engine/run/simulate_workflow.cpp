// `torquescope simulate`: the recording a job's [simulate] describes, as a file that [recording] can read.

#include <fmt/format.h>
#include <fmt/os.h>

#include <algorithm>

#include "engine/effects/model_options.hpp"
#include "engine/job/job_options.hpp"
#include "engine/run/foreign_file.hpp"
#include "engine/run/job_sections.hpp"
#include "engine/run/simulated_recordings.hpp"
#include "engine/run/workflows.hpp"
#include "engine/store/result_writer.hpp"
#include "engine/store/temp_file.hpp"

namespace torquescope {

namespace {

std::string csv_text(SimulatedRecording const& recording, std::string const& job_name) {
  auto const table = columns(recording);
  fmt::memory_buffer text;
  auto out = std::back_inserter(text);
  fmt::format_to(out, "# {}: simulated by torquescope, {:.6g} Hz\n", job_name, recording.rate_hz);
  for (auto const& value : recording.truth) fmt::format_to(out, "# truth: {} = {}\n", value.name, value.value);
  std::vector<std::string> names;
  for (auto const& column : table) names.push_back(column.name);
  fmt::format_to(out, "{}\n", fmt::join(names, ","));
  for (Eigen::Index row = 0; row < recording.time_s.size(); ++row) {
    for (std::size_t c = 0; c < table.size(); ++c) fmt::format_to(out, "{}{}", c ? "," : "", (*table[c].values)[row]);
    text.push_back('\n');
  }
  return fmt::to_string(text);
}

void write_hdf5(SimulatedRecording const& recording, std::string const& job_name, std::filesystem::path const& file) {
  ResultWriter writer(file);
  for (auto const& column : columns(recording)) {
    auto const n = static_cast<std::size_t>(column.values->size());
    writer.numbers("/" + column.name, {n}, {column.values->data(), n}, {column.unit, column.name});
  }
  writer.attribute("/truth", "job", job_name);
  for (auto const& value : recording.truth) writer.attribute("/truth", value.name, value.value);
  writer.finish();
}

}  // namespace

SimulateReport simulate_recording(std::filesystem::path const& job_file, std::filesystem::path const& output) {
  Job const job = read_job_file(job_file);
  std::vector<Problem> problems;
  check_section_names(job, problems);
  auto experiment = read_options<ExperimentOptions>(job, problems);
  if (experiment.name.empty()) experiment.name = job_file.stem().string();
  auto const model = read_options<ModelOptions>(job, problems);
  if (!job.find("simulate")) {
    Problem problem;
    problem.what = "the job has no [simulate] section: there is nothing to simulate";
    problem.place.file = job.path.string();
    problem.help = "write [simulate], [simulate.plant] with inertia = ..., and see `torquescope describe simulate`";
    problems.push_back(problem);
  }
  JointKind const joint = model.joint == "prismatic" ? JointKind::prismatic : JointKind::revolute;
  SimulationPlan const plan = plan_simulation(job, joint, problems);
  if (!problems.empty()) throw Error(std::move(problems));

  SimulatedRecording const recording = simulate_joint(plan, static_cast<std::uint64_t>(experiment.seed), 0);
  if (output.extension() == ".h5" || output.extension() == ".hdf5") {
    write_hdf5(recording, experiment.name, output);
  } else {
    std::string const text = csv_text(recording, experiment.name);
    TempFile file(output);
    file.write_at(0, text.data(), text.size());
    file.publish();
  }
  return {static_cast<std::size_t>(recording.time_s.size()),
          static_cast<double>(recording.time_s.size()) / recording.rate_hz, recording.rate_hz,
          std::filesystem::file_size(output)};
}

}  // namespace torquescope
