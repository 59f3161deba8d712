#include "engine/app/result/result_json.hpp"

#include <cmath>
#include <nlohmann/json.hpp>

#include "engine/app/result/arm_tables.hpp"

namespace torquescope {

namespace {

using Json = nlohmann::ordered_json;

Json number(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

Json parameters_json(ResultSummary const& summary, EstimatorSummary const& estimator) {
  Json list = Json::array();
  for (std::size_t i = 0; i < summary.names.size(); ++i) {
    bool const has_error = !estimator.standard_error.empty();
    list.push_back({{"name", summary.names[i]},
                    {"unit", summary.units[i]},
                    {"value", number(estimator.parameters.at(i))},
                    {"mean", number(estimator.parameters_mean.at(i))},
                    {"standard_error", has_error ? number(estimator.standard_error.at(i)) : Json(nullptr)}});
    if (summary.arm && i < summary.arm->seen.size()) list.back()["seen"] = summary.arm->seen[i];
  }
  return list;
}

Json numbers_json(std::vector<double> const& values) {
  Json list = Json::array();
  for (double const value : values) list.push_back(number(value));
  return list;
}

// beside what every estimator has
void add_joint_errors(EstimatorSummary const& estimator, Json& json) {
  json["arm"] = {{"joint_relerr", numbers_json(estimator.joint_relerr)},
                 {"joint_relerr_all_rows", numbers_json(estimator.joint_relerr_all_rows)},
                 {"relerr_all_rows", number(estimator.relerr_all_rows)},
                 {"validation_joint_relerr", numbers_json(estimator.validation_joint_relerr)},
                 {"validation_joint_relerr_all_rows", numbers_json(estimator.validation_joint_relerr_all_rows)},
                 {"validation_relerr_all_rows", number(estimator.validation_relerr_all_rows)}};
}

Json arm_json(ArmSummary const& arm) {
  Json parameters = Json::array();
  for (std::size_t i = 0; i < arm.parameters.size(); ++i)
    parameters.push_back({{"name", arm.parameters[i]}, {"unit", arm.units.at(i)}, {"gathers", arm.gathers.at(i)}});
  return {{"robot", arm.robot},
          {"joints", arm.joints},
          {"noise", numbers_json(arm.noise)},
          {"base_parameters", parameters}};
}

Json estimator_json(ResultSummary const& summary, EstimatorSummary const& estimator) {
  return {{"name", estimator.name},
          {"kind", estimator.kind},
          {"title", estimator.title},
          {"runs", estimator.runs},
          {"evaluations", estimator.evaluations},
          {"parameters", parameters_json(summary, estimator)},
          {"mse",
           {{"median", number(estimator.mse_median)},
            {"mean", number(estimator.mse_mean)},
            {"lower_quartile", number(estimator.mse_lower_quartile)},
            {"upper_quartile", number(estimator.mse_upper_quartile)},
            {"best", number(estimator.mse_best)},
            {"worst", number(estimator.mse_worst)},
            {"std", number(estimator.mse_std)}}},
          {"gap_median", number(estimator.gap_median)},
          {"train_relerr", number(estimator.relerr_median)},
          {"validation_relerr", number(estimator.validation_relerr_median)},
          {"residual_std", number(estimator.residual_std_median)},
          {"stop_reasons", estimator.stop_reasons}};
}

Json data_json(DataSummary const& data) {
  return {{"recordings", data.recordings},
          {"samples", data.samples},
          {"rate_hz", number(data.rate_hz)},
          {"kept_rate_hz", number(data.kept_rate_hz)},
          {"duration_s", number(data.duration_s)},
          {"cutoff_hz", number(data.cutoff_hz)},
          {"warnings", data.warnings}};
}

}  // namespace

std::string result_json(ResultSummary const& summary) {
  Json truth = Json::array();
  for (std::size_t i = 0; i < summary.names.size(); ++i)
    truth.push_back({{"name", summary.names[i]}, {"unit", summary.units[i]}, {"truth", number(summary.truth.at(i))}});
  Json estimators = Json::array();
  for (auto const& estimator : summary.estimators) {
    estimators.push_back(estimator_json(summary, estimator));
    if (!estimator.remark.empty()) estimators.back()["remark"] = estimator.remark;
    if (summary.arm) add_joint_errors(estimator, estimators.back());
  }

  ProvenanceSummary const& made = summary.provenance;
  Json document = {
      {"schema", 1},
      {"file", summary.file.string()},
      {"bytes", summary.bytes},
      {"content_sha256", summary.content_sha256},
      {"job",
       {{"name", summary.name}, {"study", summary.study}, {"seed", summary.seed}, {"sha256", summary.job_sha256}}},
      {"model", {{"joint", summary.joint}, {"equation", summary.equation}, {"parameters", truth}}},
      {"data",
       {{"train", data_json(summary.train)},
        {"validate", summary.has_validation ? data_json(summary.validation) : Json(nullptr)},
        {"health", summary.health_words},
        {"unexplained_joints", unexplained_joints(summary)}}},
      {"runs", summary.runs()},
      {"evaluations", summary.evaluations()},
      {"estimators", estimators},
      {"provenance",
       {{"started", made.started},
        {"finished", made.finished},
        {"seconds", number(made.seconds)},
        {"host", made.host},
        {"threads", made.threads},
        {"threads_reason", made.threads_reason},
        {"vector_target", made.vector_target},
        {"version", made.version},
        {"compiler", made.compiler},
        {"build_type", made.build_type}}}};
  if (summary.arm) document["arm"] = arm_json(*summary.arm);
  return document.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace torquescope
