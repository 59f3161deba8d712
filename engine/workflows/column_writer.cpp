// `torquescope diagnose --columns`: what the engine would search, as plain numbers in a file (RESULT_FORMAT.md,
// /columns).

#include "engine/diagnose/column_export.hpp"
#include "engine/experiment/diagnosis_input.hpp"
#include "engine/experiment/runs/provenance_writer.hpp"
#include "engine/store/scale_datasets.hpp"
#include "engine/workflows/results/study_writer.hpp"
#include "engine/workflows/workflows.hpp"

namespace torquescope {

namespace {

std::span<double const> span_of(Eigen::VectorXd const& vector) {
  return {vector.data(), static_cast<std::size_t>(vector.size())};
}

void write_matrix(ResultWriter& writer, std::string const& path, Eigen::MatrixXd const& matrix, Note const& note) {
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> const rows = matrix;
  auto const n = static_cast<std::size_t>(rows.rows()), width = static_cast<std::size_t>(rows.cols());
  writer.numbers(path, {n, width}, {rows.data(), n * width}, note);
}

void write_record(ResultWriter& writer, std::string const& group, RecordColumns const& record,
                  std::vector<ShapedCandidate> const& candidates, JointKind joint,
                  std::vector<std::string> const& parameters) {
  bool const revolute = joint == JointKind::revolute;
  std::string const length = revolute ? "rad" : "m";
  auto const n = static_cast<std::size_t>(record.torque.size());
  writer.attribute(group, "recording", record.recording);
  writer.attribute(group, "kept_rate_hz", record.kept_rate_hz);
  writer.attribute(group, "cutoff_hz", record.cutoff_hz);
  std::vector<std::int64_t> const rows(record.kept_rows.begin(), record.kept_rows.end());
  writer.whole_numbers(
      group + "/row", {n}, rows,
      Note{"1", "index among the kept samples; one is missing where a row was left out"}.over({"time"}));
  writer.numbers(group + "/time", {n}, span_of(record.time_s), Note{"s", "time"}.over({"time"}));
  writer.numbers(group + "/position", {n}, span_of(record.q), Note{length, "position"}.over({"time"}));
  writer.numbers(group + "/velocity", {n}, span_of(record.dq), Note{length + "/s", "velocity"}.over({"time"}));
  writer.numbers(group + "/acceleration", {n}, span_of(record.ddq),
                 Note{length + "/s2", "acceleration"}.over({"time"}));
  writer.numbers(group + "/torque", {n}, span_of(record.torque),
                 Note{revolute ? "N m" : "N", "torque, filtered"}.over({"time"}));
  write_matrix(writer, group + "/regressor", record.regressor,
               Note{"SI", "columns of the model, filtered"}.over({"time", "parameter"}));
  write_names(writer, group, "parameter", parameters);
  for (std::size_t i = 0; i < candidates.size(); ++i)
    write_matrix(writer, group + "/candidates/" + candidates[i].effect->name(), record.candidates[i],
                 {"SI", candidates[i].effect->title() + ": columns at the shape found in training, filtered"});
}

std::vector<std::string> words_of(std::vector<EffectFamily> const& families) {
  std::vector<std::string> words;
  for (EffectFamily family : families) words.emplace_back(word(family));
  return words;
}

void write_candidate(ResultWriter& writer, std::string const& group, ShapedCandidate const& candidate) {
  Effect const& effect = *candidate.effect;
  std::vector<std::string> linear, shape_names;
  for (auto const& parameter : effect.parameters())
    (parameter.is_shape ? shape_names : linear).push_back(parameter.name);
  std::vector<std::string> not_negative;
  for (auto const& parameter : effect.parameters())
    if (!parameter.is_shape && parameter.sign() == Sign::non_negative) not_negative.push_back(parameter.name);
  writer.attribute(group, "family", std::string(word(effect.family())));
  writer.attribute(group, "families", words_of(effect.families()));
  writer.attribute(group, "acts_on", std::string(word(effect.acts_on())));
  writer.attribute(group, "is_event", std::int64_t{effect.is_event() ? 1 : 0});
  writer.attribute(group, "is_wave", std::int64_t{effect.is_wave() ? 1 : 0});
  writer.attribute(group, "linear", linear);
  if (!not_negative.empty()) writer.attribute(group, "not_negative", not_negative);
  writer.attribute(group, "grid_points", static_cast<std::int64_t>(candidate.grid_points));
  writer.attribute(group, "gain", candidate.gain);
  if (shape_names.empty()) return;
  writer.attribute(group, "shape_names", shape_names);
  writer.numbers(group + "/shape", {candidate.shape.size()}, candidate.shape, {"SI", "shape found in training"});
}

}  // namespace

ColumnsReport write_candidate_columns(Experiment const& experiment, DiagnoseRequest const& request) {
  Beginning const beginning;
  auto const& parts = experiment.parts();
  if (parts.arm)
    throw Error(problem_at(*parts.job.find("model"), "robot", "--columns writes those of one joint, and this is an arm",
                           "leave --columns out, or write a job for one joint"));
  ResultWriter writer(request.output, {.gzip = parts.output.compression == "gzip"});
  write_study(writer, experiment);
  JobInput const job(parts, request.threads.count);
  ColumnExport const found = export_columns(job.input());
  std::vector<std::string> names, not_testable;
  for (auto const& candidate : found.candidates) {
    names.push_back(candidate.effect->name());
    write_candidate(writer, "/columns/effects/" + names.back(), candidate);
  }
  for (Effect const* effect : found.not_testable) not_testable.push_back(effect->name());
  if (!names.empty()) writer.attribute("/columns", "effects", names);
  if (!not_testable.empty()) writer.attribute("/columns", "not_testable", not_testable);
  JointKind const joint = parts.regressor->joint();
  write_record(writer, "/columns/train", found.train, found.candidates, joint, parts.parameter_names());
  for (std::size_t k = 0; k < found.validate.size(); ++k)
    write_record(writer, "/columns/validate_" + std::to_string(k + 1), found.validate[k], found.candidates, joint,
                 parts.parameter_names());
  finish_result(writer, request.output, request.threads, beginning);
  return {names.size(), static_cast<std::size_t>(found.train.torque.size())};
}

}  // namespace torquescope
