#pragma once
// The scalar results of all runs of one estimator, and what a table says of them.
//
// Shapes     one entry per run, in the order of the runs
// Source     the paper's Table 3 averages parameters over runs; medians beside it, because a mean hides a failed run

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "engine/fit/problem/prediction_metrics.hpp"

namespace torquescope {

// stop_reason of a run that is not there: a partial merge
inline constexpr char missing_run[] = "missing";

struct RunResults {
  std::vector<Eigen::VectorXd> parameters;
  std::vector<double> gap;  // MSE above the OLS floor
  std::vector<PredictionMetrics> train;
  std::vector<PredictionMetrics> validate;  // empty when there is no validation data
  std::vector<std::string> stop_reason;
  std::vector<std::int64_t> evaluations;
  std::vector<std::int64_t> nonfinite;

  std::size_t runs() const { return parameters.size(); }
  std::vector<std::size_t> present() const;                        // indexes of runs that are not missing
  RunResults only(std::vector<std::size_t> const& indexes) const;  // these runs
  // one member of the metrics over all runs
  static std::vector<double> each(std::vector<PredictionMetrics> const& metrics, double PredictionMetrics::*member);
};

// the middle value, the mean of the two middle ones when n is even; n >= 1; NaN when any value is
double median(std::vector<double> values);
// standard deviation over runs (n - 1); 0 for one run
double standard_deviation(std::vector<double> const& values);
// index of the value that is the lower median: a run to show as typical
std::size_t lower_median_index(std::vector<double> const& values);
Eigen::VectorXd mean(std::vector<Eigen::VectorXd> const& vectors);

}  // namespace torquescope
