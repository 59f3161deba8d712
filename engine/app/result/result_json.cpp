#include "engine/app/result/result_json.hpp"

#include <cmath>
#include <nlohmann/json.hpp>

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
  }
  return list;
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
  for (auto const& estimator : summary.estimators) estimators.push_back(estimator_json(summary, estimator));

  ProvenanceSummary const& made = summary.provenance;
  Json const document = {
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
        {"health", summary.health_words}}},
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
  return document.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace torquescope
