// `torquescope simulate`: the recording a job's [simulate] describes, as a file that [recording] can read.

#include <fmt/format.h>
#include <fmt/os.h>

#include <algorithm>

#include "engine/effects/model_options.hpp"
#include "engine/experiment/foreign_file.hpp"
#include "engine/experiment/job/job_options.hpp"
#include "engine/experiment/job_sections.hpp"
#include "engine/experiment/simulated_arms.hpp"
#include "engine/experiment/simulated_recordings.hpp"
#include "engine/robot/robot_registry.hpp"
#include "engine/store/result_writer.hpp"
#include "engine/store/temp_file.hpp"
#include "engine/workflows/workflows.hpp"

namespace torquescope {

namespace {

// what a file shows, of a joint or of an arm
struct SimulatedTable {
  std::vector<SimulatedColumn> columns;
  std::vector<TruthValue> truth;
  double rate_hz = 0.0;

  Eigen::Index rows() const { return columns.front().values->size(); }
};

std::string csv_text(SimulatedTable const& table, std::string const& job_name) {
  fmt::memory_buffer text;
  auto out = std::back_inserter(text);
  fmt::format_to(out, "# {}: simulated by torquescope, {:.6g} Hz\n", job_name, table.rate_hz);
  for (auto const& value : table.truth) fmt::format_to(out, "# truth: {} = {}\n", value.name, value.value);
  std::vector<std::string> names;
  for (auto const& column : table.columns) names.push_back(column.name);
  fmt::format_to(out, "{}\n", fmt::join(names, ","));
  for (Eigen::Index row = 0; row < table.rows(); ++row) {
    for (std::size_t c = 0; c < table.columns.size(); ++c)
      fmt::format_to(out, "{}{}", c ? "," : "", (*table.columns[c].values)[row]);
    text.push_back('\n');
  }
  return fmt::to_string(text);
}

void write_hdf5(SimulatedTable const& table, std::string const& job_name, std::filesystem::path const& file) {
  ResultWriter writer(file);
  for (auto const& column : table.columns) {
    auto const n = static_cast<std::size_t>(column.values->size());
    writer.numbers("/" + column.name, {n}, {column.values->data(), n}, {column.unit, column.name});
  }
  writer.attribute("/truth", "job", job_name);
  for (auto const& value : table.truth) writer.attribute("/truth", value.name, value.value);
  writer.finish();
}

SimulateReport write_table(SimulatedTable const& table, std::string const& job_name,
                           std::filesystem::path const& output) {
  if (output.extension() == ".h5" || output.extension() == ".hdf5") {
    write_hdf5(table, job_name, output);
  } else {
    std::string const text = csv_text(table, job_name);
    TempFile file(output);
    file.write_at(0, text.data(), text.size());
    file.publish();
  }
  return {static_cast<std::size_t>(table.rows()), static_cast<double>(table.rows()) / table.rate_hz, table.rate_hz,
          std::filesystem::file_size(output)};
}

SimulateReport simulate_one_arm(Job const& job, ModelOptions const& model, ExperimentOptions const& experiment,
                                std::vector<Problem> problems, std::filesystem::path const& output) {
  ArmSimulationPlan const plan =
      plan_arm_simulation(job, read_robot(job.resolve(model.robot), {model.root, model.tip}), problems);
  if (!problems.empty()) throw Error(std::move(problems));
  SimulatedArm const arm = simulate_arm(plan, static_cast<std::uint64_t>(experiment.seed));
  return write_table({columns(arm), truth_values(plan), plan.simulation.rate_hz}, experiment.name, output);
}

}  // namespace

SimulateReport simulate_recording(std::filesystem::path const& job_file, std::filesystem::path const& output) {
  return simulate_recording(read_job_file(job_file), output);
}

SimulateReport simulate_recording(Job const& job, std::filesystem::path const& output) {
  std::vector<Problem> problems;
  check_section_names(job, problems);
  auto experiment = read_options<ExperimentOptions>(job, problems);
  if (experiment.name.empty()) experiment.name = job.path.stem().string();
  auto const model = read_options<ModelOptions>(job, problems);
  if (!job.find("simulate")) {
    Problem problem;
    problem.what = "the job has no [simulate] section: there is nothing to simulate";
    problem.place.file = job.path.string();
    problem.help = "write [simulate], [simulate.plant] with inertia = ..., and see `torquescope describe simulate`";
    problems.push_back(problem);
  }
  if (!model.robot.empty()) return simulate_one_arm(job, model, experiment, std::move(problems), output);

  JointKind const joint = model.joint == "prismatic" ? JointKind::prismatic : JointKind::revolute;
  SimulationPlan const plan = plan_simulation(job, joint, problems);
  if (!problems.empty()) throw Error(std::move(problems));
  SimulatedRecording const recording = simulate_joint(plan, static_cast<std::uint64_t>(experiment.seed), 0);
  return write_table({columns(recording), recording.truth, recording.rate_hz}, experiment.name, output);
}

}  // namespace torquescope
