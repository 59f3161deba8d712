#include "engine/experiment/runs/run_summary.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "engine/base/contract.hpp"

namespace torquescope {

std::vector<double> RunResults::each(std::vector<PredictionMetrics> const& metrics, double PredictionMetrics::*member) {
  std::vector<double> values;
  values.reserve(metrics.size());
  for (auto const& metric : metrics) values.push_back(metric.*member);
  return values;
}

std::vector<std::size_t> RunResults::present() const {
  std::vector<std::size_t> indexes;
  for (std::size_t run = 0; run < runs(); ++run)
    if (stop_reason[run] != missing_run) indexes.push_back(run);
  return indexes;
}

RunResults RunResults::only(std::vector<std::size_t> const& indexes) const {
  RunResults some;
  for (std::size_t const run : indexes) {
    some.parameters.push_back(parameters[run]);
    some.gap.push_back(gap[run]);
    some.train.push_back(train[run]);
    if (!validate.empty()) some.validate.push_back(validate[run]);
    some.stop_reason.push_back(stop_reason[run]);
    some.evaluations.push_back(evaluations[run]);
    some.nonfinite.push_back(nonfinite[run]);
  }
  return some;
}

namespace {

bool any_nan(std::vector<double> const& values) {
  return std::any_of(values.begin(), values.end(), [](double value) { return std::isnan(value); });
}

}  // namespace

double median(std::vector<double> values) {
  TORQUESCOPE_EXPECT(!values.empty());
  if (any_nan(values)) return std::numeric_limits<double>::quiet_NaN();
  std::sort(values.begin(), values.end());
  std::size_t const middle = values.size() / 2;
  return values.size() % 2 == 1 ? values[middle] : 0.5 * (values[middle - 1] + values[middle]);
}

double standard_deviation(std::vector<double> const& values) {
  if (values.size() < 2) return 0.0;
  auto const n = static_cast<double>(values.size());
  double const average = std::accumulate(values.begin(), values.end(), 0.0) / n;
  double sum = 0.0;
  for (double value : values) sum += (value - average) * (value - average);
  return std::sqrt(sum / (n - 1.0));
}

std::size_t lower_median_index(std::vector<double> const& values) {
  TORQUESCOPE_EXPECT(!values.empty());
  std::vector<std::size_t> order(values.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  // NaN last; ties by index, so that the answer does not depend on the sort
  auto const key = [&](std::size_t i) {
    return std::isnan(values[i]) ? std::numeric_limits<double>::infinity() : values[i];
  };
  std::sort(order.begin(), order.end(),
            [&](std::size_t a, std::size_t b) { return key(a) != key(b) ? key(a) < key(b) : a < b; });
  return order[(order.size() - 1) / 2];
}

Eigen::VectorXd mean(std::vector<Eigen::VectorXd> const& vectors) {
  TORQUESCOPE_EXPECT(!vectors.empty());
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(vectors.front().size());
  for (auto const& vector : vectors) sum += vector;
  return sum / static_cast<double>(vectors.size());
}

}  // namespace torquescope
