#include "engine/experiment/fit_findings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "engine/data/arm_recording.hpp"
#include "engine/data/filter_checks.hpp"
#include "engine/data/levels.hpp"
#include "engine/effects/passive_signs.hpp"
#include "engine/experiment/search_box.hpp"
#include "engine/experiment/torque_findings.hpp"
#include "engine/fit/problem/least_squares.hpp"
#include "engine/fit/problem/position_factor.hpp"
#include "engine/fit/problem/row_influence.hpp"

namespace torquescope {
namespace {

// What goes into the joint over the recording (up to the time step); less than none of a passive one
double work(RegressionData const& rows) {
  auto const velocity = rows.velocity();
  if (static_cast<Eigen::Index>(velocity.size()) != rows.rows()) return 0.0;
  return rows.tau.dot(Eigen::Map<Eigen::VectorXd const>(velocity.data(), rows.rows()));
}

std::string torque_column(RecordingOptions const& options) {
  auto const torque = options.columns.find("torque");
  return torque != options.columns.end() ? torque->second : std::string();
}

std::optional<Finding> sign_finding(Experiment::Parts const& parts, RecordingOptions const& options) {
  auto const& rows = parts.train.regression;
  if (!parts.health.identifiable || is_computed(parts.train.recordings)) return {};
  Eigen::VectorXd const parameters = solve_reduced(rows, parts.reductions);
  Eigen::VectorXd const signs = passive_signs(*parts.regressor);
  if (!((signs.array() * parameters.array()) < 0.0).any()) return {};

  bool const takes_work_out = work(rows) < 0.0;
  double const surely = takes_work_out ? levels::negative_beside_negative_work : levels::surely_negative;
  auto const fit = fit_with_errors(rows, parameters);
  Finding finding{FindingKind::less_than_none, takes_work_out ? Grade::fault : Grade::warning};
  std::int64_t const possible = (signs.array() != 0.0).count();
  for (Eigen::Index i = 0; i < signs.size(); ++i) {
    auto const k = static_cast<std::size_t>(i);
    if (signs[i] == 0.0 || !(signs[i] * parameters[i] < -surely * fit.standard_error[i])) continue;
    ++finding.count;
    finding.detail += fmt::format("{}{} = {:.3g} {}", finding.detail.empty() ? "" : ", ", rows.columns[k].name,
                                  parameters[i], rows.columns[k].unit);
  }
  if (finding.count == 0) return {};
  finding.column = torque_column(options);
  if (takes_work_out && finding.count == possible && possible >= 2) {
    finding.kind = FindingKind::wrong_sign;
    finding.size = -options.torque_factor();
    return finding;
  }
  // one of a moving arm may well give away work that its neighbours put in
  auto const& known = parts.train.recordings.front().findings;
  if (std::any_of(known.begin(), known.end(),
                  [](Finding const& one) { return one.kind == FindingKind::other_joints_move; }))
    finding.grade = Grade::warning;
  return finding;
}

std::optional<Finding> factor_finding(Experiment::Parts const& parts, RecordingOptions const& options) {
  auto const factor = position_factor(parts.train.regression, *parts.regressor);
  if (!factor) return {};
  // a unit that people forget is no accident; a ratio may be an effect of the position that the model lacks
  Finding finding{FindingKind::position_factor, factor->words.empty() ? Grade::warning : Grade::fault};
  finding.size = factor->factor;
  finding.detail = factor->words;
  finding.written = options.position_per_unit;
  finding.error_before = factor->error_before;
  finding.error_after = factor->error_after;
  if (auto const position = options.columns.find("position"); position != options.columns.end())
    finding.column = position->second;
  return finding;
}

// kept rows at each side over which the filters spread a sample: a period of the lower cut-off
Eigen::Index spread_of_filters(FilterOptions const& filter, double kept_rate_hz) {
  double lowest_hz = 0.0;
  for (double cutoff_hz : {filter.cutoff_hz, parallel_cutoff_of(filter)})
    if (cutoff_hz > 0.0) lowest_hz = lowest_hz > 0.0 ? std::min(lowest_hz, cutoff_hz) : cutoff_hz;
  return lowest_hz > 0.0 ? static_cast<Eigen::Index>(std::ceil(kept_rate_hz / lowest_hz)) : 0;
}

// the row of the fit at a time of one recording; none where it looks at none
std::optional<Eigen::Index> row_at(RegressionData const& rows, std::size_t recording, double time_s) {
  auto const first = rows.first_row[recording], end = rows.first_row[recording + 1];
  std::vector<double> times(static_cast<std::size_t>(end - first));
  rows.time(static_cast<std::size_t>(first), times);
  auto const next = std::lower_bound(times.begin(), times.end(), time_s);
  if (next == times.end() || *next - time_s > 1.0 / rows.kept_rate_hz) return {};
  return first + static_cast<Eigen::Index>(next - times.begin());
}

Finding influence_words(RegressionData const& rows, LoneRow const& lone, RowInfluence const& influence) {
  auto const& column = rows.columns[static_cast<std::size_t>(influence.parameter)];
  Finding finding{FindingKind::one_row_decides, Grade::warning};
  finding.column = lone.column;
  finding.count = 1;
  finding.lines = {lone.line};
  finding.size = lone.time_s;
  finding.detail = fmt::format("{} from {:.3g} to {:.3g} {}, {:.2g} standard errors", column.name, influence.without,
                               influence.without + influence.change, column.unit, influence.errors);
  return finding;
}

}  // namespace

std::optional<Finding> influence_finding(Experiment::Parts const& parts) {
  auto const& lone_rows = parts.train.lone;
  bool const are_any = std::any_of(lone_rows.begin(), lone_rows.end(), [](auto const& some) { return !some.empty(); });
  bool const has_gains = parts.train.regression.arm && !parts.train.regression.arm->gain_column.empty();
  if (!parts.health.identifiable || !are_any || has_gains) return {};
  auto const& rows = parts.train.regression;
  RowInfluences const influences(rows, solve_reduced(rows, parts.reductions),
                                 spread_of_filters(parts.filter, rows.kept_rate_hz));
  std::optional<Finding> found;
  double most = levels::errors_of_one_row;
  for (std::size_t k = 0; k < rows.recordings(); ++k)
    for (auto const& lone : lone_rows[k]) {
      auto const row = row_at(rows, k, lone.time_s);
      if (!row) continue;
      for (auto const& one : influences.of(*row)) {
        if (one.errors <= most || std::fabs(one.change) < levels::share_of_one_row * std::fabs(one.without)) continue;
        most = one.errors;
        found = influence_words(rows, lone, one);
        found->recording = rows.recording_names[k];
        if (rows.arm) found->joint = joint_title(rows.arm->joint[k], parts.arm->model.joint_names());
      }
    }
  return found;
}

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

std::vector<Finding> fit_findings(Experiment::Parts const& parts, RecordingOptions const& options) {
  std::vector<Finding> findings;
  if (too_few_rows(parts.train.regression)) return findings;
  for (auto& found : {sign_finding(parts, options), factor_finding(parts, options), influence_finding(parts)}) {
    if (!found) continue;
    findings.push_back(*found);
    if (found->recording.empty()) findings.back().recording = parts.train.recordings.front().name;
  }
  return findings;
}

Bounds box_from_recordings(Experiment::Parts const& parts) {
  auto const& rows = parts.train.regression;
  if (too_few_rows(rows) || !parts.health.identifiable) return parts.box;
  Eigen::VectorXd const values = solve_reduced(rows, parts.reductions);
  auto const freedom = static_cast<double>(rows.rows() - rows.parameters());
  double const variance = (rows.tau - rows.phi * values).squaredNorm() / freedom;
  Eigen::VectorXd const errors = (variance * inverse_information(rows, {}).diagonal()).cwiseSqrt();
  return default_box(values, errors);
}

}  // namespace torquescope
