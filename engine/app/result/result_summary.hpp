#pragma once
// What the tables and the JSON say about a result: read from its file once, or kept by whoever wrote it.
//
// Shapes     R parameters; vectors named after runs have one entry per run
// Units      as in the file (RESULT_FORMAT.md); absent numbers are NaN
// Errors     Error 66 (no such file), 65 (not a result file, damaged)

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "engine/store/look_at_result.hpp"
#include "engine/store/result_reader.hpp"
#include "engine/store/written_result.hpp"

namespace torquescope {

struct EstimatorSummary {
  std::string name, kind, title;
  std::string rollout_unit;                 // of the error, where it is one of rollouts; "" of rows
  std::string remark;                       // of a closed form: what a person should know; "" where it has none
  std::int64_t runs = 0, missing_runs = 0;  // missing: of a partial merge
  std::vector<double> parameters;           // [R] of the median run
  std::vector<double> parameters_mean;      // [R] over the runs, as a paper would average them
  std::vector<double> standard_error;       // [R] least squares only: HAC; else empty
  double mse_median = 0.0, mse_best = 0.0, mse_worst = 0.0, mse_std = 0.0, mse_mean = 0.0;
  double mse_lower_quartile = 0.0, mse_upper_quartile = 0.0;
  // MSE above the OLS floor: what tells searches apart once their MSEs agree to every printed digit
  double gap_median = 0.0, gap_lower_quartile = 0.0, gap_upper_quartile = 0.0, gap_best = 0.0, gap_worst = 0.0;
  double relerr_median = 0.0, validation_relerr_median = 0.0;
  double residual_std_median = 0.0;
  std::map<std::string, std::int64_t> stop_reasons;  // how many runs ended for which reason
  std::int64_t evaluations = 0;
  // of an arm, of the median run: one a joint; validation ones are empty without validation data
  std::vector<double> joint_relerr, joint_relerr_all_rows, validation_joint_relerr, validation_joint_relerr_all_rows;
  double relerr_all_rows = 0.0, validation_relerr_all_rows = 0.0;
};

// what only the result of an arm has
struct ArmSummary {
  std::string robot;
  std::vector<std::string> joints;                      // names, from the base to the tip
  std::vector<double> noise;                            // N m or N, of each joint
  std::vector<std::string> parameters, units, gathers;  // base parameters, and what each is the sum of
  std::vector<std::string> seen;                        // [R] "alone", "group", "no"; of an earlier version empty
};

struct DataSummary {
  std::vector<std::string> recordings;
  std::int64_t samples = 0;  // kept for the fit
  double rate_hz = 0.0, kept_rate_hz = 0.0, duration_s = 0.0, cutoff_hz = 0.0;
  std::vector<std::string> warnings;
};

struct ProvenanceSummary {
  std::string started, finished, host, threads_reason, vector_target, version, compiler, build_type;
  double seconds = 0.0;
  std::int64_t threads = 0;
};

struct ResultSummary {
  std::filesystem::path file;
  std::uintmax_t bytes = 0;
  std::string content_sha256;
  std::string name, study, job_sha256, inputs_sha256;
  std::int64_t seed = 0;
  std::string joint, torque_unit, equation, health_words;  // torque_unit: "" in files before 28 Nov 2026
  std::vector<std::string> names, units;                   // [R]
  std::vector<double> truth;                               // [R] NaN where unknown
  std::optional<ArmSummary> arm{};
  DataSummary train;
  bool has_validation = false;
  DataSummary validation;
  std::vector<EstimatorSummary> estimators;  // in the order of the job; none in a diagnosis
  bool has_diagnosis = false;
  ProvenanceSummary provenance;

  std::int64_t runs() const;  // of all estimators
  std::int64_t evaluations() const;
  bool is_partial() const;  // some runs are missing
};

// looks at it first
ResultSummary read_summary(std::filesystem::path const& file);
// the same of a result that was written just now
ResultSummary summary_of(WrittenResult const& result);

// Error 65 for a file of `diagnose --columns`: there is nothing to show in it
void refuse_columns(ResultReader const& reader);

// the value below which a share of the values lies, between neighbours linearly; NaN for none
double quantile(std::vector<double> values, double share);

}  // namespace torquescope
