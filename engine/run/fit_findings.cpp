#include "engine/run/fit_findings.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "engine/pipeline/joint_model.hpp"
#include "engine/problem/least_squares.hpp"

namespace torquescope {
namespace {

LeastSquaresFit fit_with_errors(RegressionData const& data, Eigen::VectorXd parameters) {
  LeastSquaresFit fit;
  fit.parameters = std::move(parameters);
  Eigen::VectorXd const residual = data.tau - data.phi * fit.parameters;
  auto const freedom = static_cast<double>(std::max<Eigen::Index>(data.rows() - data.parameters(), 1));
  auto const bread = inverse_information(data, {});
  fit.covariance_naive = residual.squaredNorm() / freedom * bread;
  constexpr std::int64_t automatic_lags = -1;
  finish_fit(fit, data, residual, bread, automatic_lags);
  return fit;
}

}  // namespace

std::vector<Finding> fit_findings(Experiment::Parts const& parts, RecordingOptions const& options) {
  constexpr double surely = 4.0;
  auto const& rows = parts.train.regression;
  if (too_few_rows(rows) || !parts.health.identifiable) return {};
  Eigen::VectorXd const parameters = solve_reduced(rows, parts.reductions);
  auto const cannot_be_negative = JointModel(*parts.regressor).non_negative();
  bool any = false;
  for (std::size_t k = 0; k < cannot_be_negative.size(); ++k)
    any = any || (cannot_be_negative[k] && parameters[static_cast<Eigen::Index>(k)] < 0.0);
  if (!any) return {};

  auto const fit = fit_with_errors(rows, parameters);
  Finding finding{FindingKind::less_than_none, Grade::warning};
  std::int64_t possible = 0;
  for (std::size_t k = 0; k < cannot_be_negative.size(); ++k) {
    auto const i = static_cast<Eigen::Index>(k);
    possible += cannot_be_negative[k];
    if (!cannot_be_negative[k] || !(parameters[i] < -surely * fit.standard_error[i])) continue;
    ++finding.count;
    finding.detail += fmt::format("{}{} = {:.3g} {}", finding.detail.empty() ? "" : ", ", rows.columns[k].name,
                                  parameters[i], rows.columns[k].unit);
  }
  if (finding.count == 0) return {};
  finding.recording = parts.train.recordings.front().name;
  if (auto const torque = options.columns.find("torque"); torque != options.columns.end())
    finding.column = torque->second;
  if (finding.count >= 2) finding.grade = Grade::fault;
  if (finding.count == possible && possible >= 2) {
    finding.kind = FindingKind::wrong_sign;
    finding.size = -options.torque_per_unit;
  }
  return {finding};
}

}  // namespace torquescope
