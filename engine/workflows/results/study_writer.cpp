#include "engine/workflows/results/study_writer.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "engine/data/health/finding_text.hpp"
#include "engine/effects/joint_form.hpp"
#include "engine/store/scale_datasets.hpp"
#include "engine/workflows/results/arm_writer.hpp"

namespace torquescope {

namespace {

std::span<double const> numbers_of(Eigen::VectorXd const& vector) {
  return {vector.data(), static_cast<std::size_t>(vector.size())};
}

void write_job(ResultWriter& writer, Experiment::Parts const& parts) {
  writer.texts("/job/text", std::vector<std::string>{parts.job.text}, {"1", "job file, verbatim"});
  writer.attribute("/job", "name", parts.experiment.name);
  writer.attribute("/job", "study", parts.experiment.study);
  writer.attribute("/job", "seed", parts.experiment.seed);
  writer.attribute("/job", "runs", parts.experiment.runs);
  writer.attribute("/job", "sha256", parts.job.sha256);
}

void write_model(ResultWriter& writer, Experiment::Parts const& parts) {
  std::size_t const n = parts.parameters();
  write_names(writer, "/model", "parameter", parts.parameter_names());
  writer.texts("/model/names", parts.parameter_names(), Note{"1", "parameter names"}.over({"parameter"}));
  writer.texts("/model/units", parts.parameter_units(), Note{"1", "parameter units"}.over({"parameter"}));
  writer.numbers("/model/truth", {n}, numbers_of(parts.truth),
                 Note{"SI", "true parameters of the simulated joint"}.over({"parameter"}));
  writer.numbers("/model/lower", {n}, parts.box.lower, Note{"SI", "lower end of the box"}.over({"parameter"}));
  writer.numbers("/model/upper", {n}, parts.box.upper, Note{"SI", "upper end of the box"}.over({"parameter"}));
  if (parts.arm) {
    writer.attribute("/model", "joint", std::string("arm"));
    writer.attribute("/model", "equation", parts.arm->model.equation());
    return;
  }
  writer.attribute("/model", "torque_unit", parts.torque_unit());
  Regressor const& regressor = *parts.regressor;
  bool const revolute = regressor.joint() == JointKind::revolute;
  writer.attribute("/model", "joint", std::string(revolute ? "revolute" : "prismatic"));
  writer.attribute("/model", "equation", regressor.equation());
  if (auto const form = joint_form(regressor)) {
    write_names(writer, "/model", "form", form->names);
    writer.texts("/model/joint_form_names", form->names, Note{"1", "names of the equivalent form"}.over({"form"}));
    writer.texts("/model/joint_form_units", form->units, Note{"1", "units of the equivalent form"}.over({"form"}));
  }
}

void write_data_attributes(ResultWriter& writer, std::string const& group, DataSet const& set,
                           FilterOptions const& filter) {
  std::vector<std::string> names, digests;
  double duration_s = 0.0;
  for (std::size_t k = 0; k < set.recordings.size(); ++k) {
    auto const& recording = set.recordings[k];
    names.push_back(recording.name);
    digests.push_back(recording.sha256);
    duration_s += static_cast<double>(set.n_samples[k]) / recording.rate_hz;
  }
  writer.attribute(group, "recordings", names);
  writer.attribute(group, "sha256", digests);
  writer.attribute(group, "rate_hz", set.recordings.front().rate_hz);
  writer.attribute(group, "kept_rate_hz", set.regression.kept_rate_hz);
  writer.attribute(group, "duration_s", duration_s);
  writer.attribute(group, "simulated", std::int64_t{set.simulated ? 1 : 0});
  for (auto const& [key, value] : FilterOptions::table().values(filter)) writer.attribute(group, key, value);
  std::int64_t reversals = 0;
  for (auto const& facts : set.excitation) reversals += static_cast<std::int64_t>(facts.reversals);
  writer.attribute(group, "reversals", reversals);
}

void write_samples(ResultWriter& writer, std::string const& group, RegressionData const& data, JointKind joint,
                   std::string const& torque_unit, std::vector<std::string> const& parameters) {
  auto const n = static_cast<std::size_t>(data.rows());
  bool const revolute = joint == JointKind::revolute;
  std::string const length = revolute ? "rad" : "m";
  writer.numbers_in_blocks(
      group + "/time", {n}, [&](std::size_t first, std::span<double> seconds) { data.time(first, seconds); },
      Note{"s", "time"}.over({"time"}));
  writer.whole_numbers_in_blocks(
      group + "/recording", {n},
      [&](std::size_t first, std::span<std::int64_t> values) {
        for (std::size_t i = 0; i < values.size();) {
          std::size_t const k = data.recording_of(static_cast<Eigen::Index>(first + i));
          std::size_t const end = std::min(values.size(), static_cast<std::size_t>(data.first_row[k + 1]) - first);
          std::fill(values.begin() + static_cast<std::ptrdiff_t>(i), values.begin() + static_cast<std::ptrdiff_t>(end),
                    static_cast<std::int64_t>(k));
          i = end;
        }
      },
      Note{"1", "index of the recording"}.over({"time"}));
  writer.numbers(group + "/position", {n}, numbers_of(data.q), Note{length, "position"}.over({"time"}));
  writer.numbers(group + "/velocity", {n}, data.velocity(), Note{length + "/s", "velocity"}.over({"time"}));
  writer.numbers(group + "/acceleration", {n}, data.acceleration(),
                 Note{length + "/s2", "acceleration"}.over({"time"}));
  writer.numbers(group + "/torque", {n}, numbers_of(data.tau),
                 Note{torque_unit, revolute ? "torque" : "force"}.over({"time"}));
  auto const columns = static_cast<std::size_t>(data.parameters());
  writer.numbers_in_blocks(
      group + "/regressor", {n, columns},
      [&](std::size_t first, std::span<double> values) {
        auto const count = static_cast<Eigen::Index>(values.size() / columns);
        Eigen::Map<Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>>(
            values.data(), count, data.parameters()) = data.phi.middleRows(static_cast<Eigen::Index>(first), count);
      },
      Note{"SI", "regressor"}.over({"time", "parameter"}));
  write_names(writer, group, "parameter", parameters);
  writer.plottable(group, "torque", {"time"});
}

void write_data_set(ResultWriter& writer, std::string const& group, DataSet const& set,
                    Experiment::Parts const& parts) {
  if (parts.arm)
    write_arm_samples(writer, group, set, parts);
  else if (parts.output.samples)
    write_samples(writer, group, set.regression, parts.regressor->joint(), parts.torque_unit(),
                  parts.row_parameter_names());
  else
    writer.attribute(group, "samples", static_cast<std::int64_t>(set.regression.rows()));
  std::vector<std::string> warnings;
  for (auto const& recording : set.recordings)
    for (auto const& finding : recording.findings)
      if (finding.grade != Grade::note)
        warnings.push_back(
            fmt::format("{}: {}: {}", recording.name, code_of(finding.kind), sentence_with_cure(finding)));
  for (auto const& recording : set.recordings)
    for (auto const& warning : recording.warnings)
      warnings.push_back(fmt::format("{}: {}: {}", recording.name, warning.topic, warning.text));
  if (!warnings.empty()) {
    writer.texts(group + "/warnings", warnings, Note{"1", "what `check` would say"}.over({"warning"}));
    write_index(writer, group, "warning", warnings.size());
  }
  write_data_attributes(writer, group, set, parts.filter);
}

void write_health(ResultWriter& writer, RegressorHealth const& health, std::vector<std::string> const& parameters) {
  Eigen::MatrixXd const& correlation = health.correlation;  // symmetric: row-major is column-major
  auto const n = static_cast<std::size_t>(correlation.rows());
  writer.numbers("/data/regressor_health/correlation", {n, n}, {correlation.data(), n * n},
                 Note{"1", "correlation of the regressor's columns (uncentred)"}.over({"parameter", "with_parameter"}));
  for (std::string const name : {"parameter", "with_parameter"})
    write_names(writer, "/data/regressor_health", name, parameters);
  writer.attribute("/data/regressor_health", "condition_number", health.condition_number);
  writer.attribute("/data/regressor_health", "words", health.words);
}

}  // namespace

void write_study(ResultWriter& writer, Experiment const& experiment) {
  Experiment::Parts const& parts = experiment.parts();
  write_job(writer, parts);
  writer.attribute("/job", "inputs_sha256", experiment.inputs_sha256());
  write_model(writer, parts);
  if (parts.arm) write_arm(writer, parts);
  write_data_set(writer, "/data/train", parts.train, parts);
  if (parts.validate) write_data_set(writer, "/data/validate", *parts.validate, parts);
  write_health(writer, parts.health, parts.row_parameter_names());
}

}  // namespace torquescope
