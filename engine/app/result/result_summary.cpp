#include "engine/app/result/result_summary.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>
#include <numeric>

#include "engine/base/error.hpp"
#include "engine/store/result_files.hpp"

namespace torquescope {

namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

// Source: ResultReader or WrittenResult

template <class Source>
double number_or_nan(Source const& reader, std::string const& object, std::string const& name) {
  return reader.template find_attribute<double>(object, name).value_or(nan);
}

template <class Source>
std::string text_or_empty(Source const& reader, std::string const& object, std::string const& name) {
  return reader.template find_attribute<std::string>(object, name).value_or("");
}

// row `run` of a [run][R] dataset; empty when there is no such dataset
template <class Source>
std::vector<double> row_of(Source const& reader, std::string const& dataset, std::size_t run, std::size_t columns) {
  if (!reader.exists(dataset)) return {};
  auto const numbers = reader.numbers(dataset);
  if ((run + 1) * columns > numbers.values.size()) return std::vector<double>(columns, nan);
  auto const begin = numbers.values.begin() + static_cast<std::ptrdiff_t>(run * columns);
  return {begin, begin + static_cast<std::ptrdiff_t>(columns)};
}

template <class Source>
EstimatorSummary read_estimator(Source const& reader, std::string const& name, std::size_t parameter_count) {
  std::string const group = "/runs/" + name;
  EstimatorSummary summary;
  summary.name = name;
  summary.kind = reader.template attribute<std::string>(group, "kind");
  summary.title = text_or_empty(reader, group, "title");
  summary.remark = text_or_empty(reader, group, "remark");
  summary.rollout_unit = text_or_empty(reader, group, "rollout_error_unit");
  summary.runs = reader.template attribute<std::int64_t>(group, "runs");
  summary.missing_runs = reader.template find_attribute<std::int64_t>(group, "missing_runs").value_or(0);
  summary.evaluations = reader.template find_attribute<std::int64_t>(group, "evaluations_total").value_or(0);

  auto const median_run = static_cast<std::size_t>(
      std::max<std::int64_t>(0, reader.template find_attribute<std::int64_t>(group, "median_run").value_or(0)));
  summary.parameters = row_of(reader, group + "/parameters", median_run, parameter_count);
  summary.standard_error = row_of(reader, group + "/standard_error", median_run, parameter_count);
  summary.parameters_mean =
      reader.template find_attribute<std::vector<double>>(group, "parameters_mean").value_or(summary.parameters);

  std::vector<double> const mse = reader.numbers(group + "/mse").values;
  summary.mse_median = number_or_nan(reader, group, "mse_median");
  summary.mse_best = number_or_nan(reader, group, "mse_best");
  summary.mse_worst = number_or_nan(reader, group, "mse_worst");
  summary.mse_std = number_or_nan(reader, group, "mse_std");
  summary.mse_mean = std::accumulate(mse.begin(), mse.end(), 0.0) / static_cast<double>(mse.size());
  summary.mse_lower_quartile = quantile(mse, 0.25);
  summary.mse_upper_quartile = quantile(mse, 0.75);
  summary.gap_median = number_or_nan(reader, group, "gap_median");
  auto const gap = reader.numbers(group + "/gap").values;
  summary.gap_lower_quartile = quantile(gap, 0.25);
  summary.gap_upper_quartile = quantile(gap, 0.75);
  summary.gap_best = quantile(gap, 0.0);
  summary.gap_worst = quantile(gap, 1.0);
  summary.relerr_median = number_or_nan(reader, group, "relerr_median");
  summary.validation_relerr_median = number_or_nan(reader, group, "validation_relerr_median");
  summary.residual_std_median = number_or_nan(reader, group, "residual_std_median");
  for (auto const& reason : reader.texts(group + "/stop_reason")) ++summary.stop_reasons[reason];
  auto const of_joints = [&](char const* errors) {
    std::string const dataset = group + "/" + errors;
    return reader.exists(dataset) ? reader.numbers(dataset).values : std::vector<double>();
  };
  summary.joint_relerr = of_joints("joint_relerr");
  summary.joint_relerr_all_rows = of_joints("joint_relerr_all_rows");
  summary.validation_joint_relerr = of_joints("validation_joint_relerr");
  summary.validation_joint_relerr_all_rows = of_joints("validation_joint_relerr_all_rows");
  summary.relerr_all_rows = number_or_nan(reader, group, "relerr_all_rows");
  summary.validation_relerr_all_rows = number_or_nan(reader, group, "validation_relerr_all_rows");
  return summary;
}

template <class Source>
std::optional<ArmSummary> read_arm_summary(Source const& reader) {
  if (!reader.exists("/arm")) return {};
  ArmSummary arm;
  arm.robot = text_or_empty(reader, "/robot", "name");
  arm.joints = reader.texts("/robot/joints");
  arm.noise = reader.numbers("/arm/noise").values;
  arm.parameters = reader.texts("/robot/base_parameters");
  arm.units = reader.texts("/robot/base_units");
  arm.gathers = reader.texts("/robot/gathers");
  if (reader.exists("/arm/seen")) arm.seen = reader.texts("/arm/seen");
  return arm;
}

std::size_t samples_of(h5::Shape const& shape) { return shape.empty() ? 1 : shape.front(); }

template <class Source>
DataSummary read_data(Source const& reader, std::string const& group) {
  DataSummary summary;
  summary.recordings = reader.template find_attribute<std::vector<std::string>>(group, "recordings")
                           .value_or(std::vector<std::string>{});
  // without its samples a result says how many there were
  summary.samples = reader.exists(group + "/time")
                        ? static_cast<std::int64_t>(samples_of(reader.shape(group + "/time")))
                        : reader.template attribute<std::int64_t>(group, "samples");
  summary.rate_hz = number_or_nan(reader, group, "rate_hz");
  summary.kept_rate_hz = number_or_nan(reader, group, "kept_rate_hz");
  summary.duration_s = number_or_nan(reader, group, "duration_s");
  summary.cutoff_hz = number_or_nan(reader, group, "cutoff_hz");
  if (reader.exists(group + "/warnings")) summary.warnings = reader.texts(group + "/warnings");
  return summary;
}

// when, where and by whom: beside the result, or in it when it is of an older version
nlohmann::json read_circumstances(std::filesystem::path const& result, std::string const& content_sha256) {
  std::ifstream file(circumstances_file_of(result));
  auto const made = nlohmann::json::parse(file, nullptr, false);
  // what another result of this name left behind says nothing of this one
  bool const fits = made.is_object() && made.contains("content_sha256") && made["content_sha256"] == content_sha256;
  return fits ? made : nlohmann::json();
}

template <class Source>
ProvenanceSummary read_provenance(Source const& reader, std::string const& content_sha256) {
  std::string const group = "/provenance";
  nlohmann::json const made = read_circumstances(reader.name(), content_sha256);
  auto const text = [&](char const* key) {
    bool const told = made.is_object() && made.contains(key) && made[key].is_string();
    return told ? made[key].get<std::string>() : text_or_empty(reader, group, key);
  };
  auto const number = [&](char const* key) {
    bool const told = made.is_object() && made.contains(key) && made[key].is_number();
    return told ? made[key].get<double>() : number_or_nan(reader, group, key);
  };
  ProvenanceSummary summary;
  summary.started = text("started");
  summary.finished = text("finished");
  summary.host = text("host");
  summary.threads_reason = text("threads_reason");
  summary.vector_target = text("vector_target");
  summary.version = text("version");
  summary.compiler = text("compiler");
  summary.build_type = text("build_type");
  summary.seconds = number("seconds");
  double const threads = number("threads");
  summary.threads = std::isnan(threads) ? 0 : static_cast<std::int64_t>(threads);
  return summary;
}

}  // namespace

std::int64_t ResultSummary::runs() const {
  std::int64_t sum = 0;
  for (auto const& estimator : estimators) sum += estimator.runs;
  return sum;
}

std::int64_t ResultSummary::evaluations() const {
  std::int64_t sum = 0;
  for (auto const& estimator : estimators) sum += estimator.evaluations;
  return sum;
}

bool ResultSummary::is_partial() const {
  return std::any_of(estimators.begin(), estimators.end(), [](auto const& e) { return e.missing_runs > 0; });
}

double quantile(std::vector<double> values, double share) {
  std::erase_if(values, [](double value) { return std::isnan(value); });
  if (values.empty()) return nan;
  std::sort(values.begin(), values.end());
  double const position = share * static_cast<double>(values.size() - 1);
  auto const below = static_cast<std::size_t>(position);
  std::size_t const above = std::min(below + 1, values.size() - 1);
  double const fraction = position - static_cast<double>(below);
  // not a weighted sum: equal neighbours must give themselves, infinite ones no NaN
  return values[below] == values[above] ? values[below] : values[below] + fraction * (values[above] - values[below]);
}

void refuse_columns(ResultReader const& reader) {
  validate(!reader.exists("/columns"), [&] {
    Problem problem{ExitCode::bad_data, reader.name().string() + " holds columns for other methods, no result"};
    problem.help = "torquescope diagnose JOB.toml without --columns makes one";
    return problem;
  });
}

namespace {

template <class Source>
ResultSummary summarise(Source const& reader) {
  ResultSummary summary;
  summary.file = reader.name();
  summary.bytes = std::filesystem::file_size(summary.file);
  summary.content_sha256 = reader.content_sha256();
  summary.name = reader.template attribute<std::string>("/job", "name");
  summary.study = text_or_empty(reader, "/job", "study");
  summary.job_sha256 = reader.template attribute<std::string>("/job", "sha256");
  summary.inputs_sha256 = reader.template attribute<std::string>("/job", "inputs_sha256");
  summary.seed = reader.template attribute<std::int64_t>("/job", "seed");
  summary.joint = text_or_empty(reader, "/model", "joint");
  summary.torque_unit = text_or_empty(reader, "/model", "torque_unit");
  summary.equation = text_or_empty(reader, "/model", "equation");
  summary.names = reader.texts("/model/names");
  summary.units = reader.texts("/model/units");
  summary.truth = reader.numbers("/model/truth").values;
  summary.health_words = text_or_empty(reader, "/data/regressor_health", "words");
  summary.arm = read_arm_summary(reader);
  summary.train = read_data(reader, "/data/train");
  summary.has_validation = reader.exists("/data/validate");
  if (summary.has_validation) summary.validation = read_data(reader, "/data/validate");
  summary.has_diagnosis = reader.exists("/diagnosis");
  // a diagnosis has no runs; any other result without them is damaged
  if (!summary.has_diagnosis || reader.exists("/runs"))
    for (auto const& name : reader.template attribute<std::vector<std::string>>("/runs", "order"))
      summary.estimators.push_back(read_estimator(reader, name, summary.names.size()));
  summary.provenance = read_provenance(reader, summary.content_sha256);
  return summary;
}

}  // namespace

ResultSummary read_summary(std::filesystem::path const& file) {
  auto const read = [](ResultReader const& reader) {
    refuse_columns(reader);
    return summarise(reader);
  };
  look_at_result(file, read);
  return read(ResultReader(file));
}

ResultSummary summary_of(WrittenResult const& result) { return summarise(result); }

}  // namespace torquescope
