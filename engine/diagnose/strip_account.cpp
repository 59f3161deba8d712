#include "engine/diagnose/strip_account.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/fit/statistics/scaled_solution.hpp"
#include "engine/infer/locate/mismatch_map.hpp"

namespace torquescope {
namespace {

constexpr Eigen::Index fewest_replicates = 8;  // of a map

Eigen::VectorXd parameters_of(FittedModel const& by) {
  return by.fitted->parameters().head(static_cast<Eigen::Index>(by.model->size()));
}

Eigen::VectorXd effect_alone(FittedModel const& by, std::size_t i) {
  auto const first = static_cast<Eigen::Index>(by.model->first_parameter(i));
  auto const count = static_cast<Eigen::Index>(by.model->effects()[i].effect->n_linear());
  Eigen::VectorXd alone = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(by.model->size()));
  alone.segment(first, count) = by.fitted->parameters().segment(first, count);
  return alone;
}

// of the first strip, at the effects' rate
Eigen::VectorXd torque_by(FittedModel const& by, Eigen::VectorXd const& parameters) {
  return model_torque(by.fitted->on(), 0, by.fitted->chosen().fit.samples.front(), parameters);
}

Eigen::VectorXd distance_since(Eigen::VectorXd const& signal, Eigen::VectorXd const& q) {
  Eigen::VectorXd distance = Eigen::VectorXd::Zero(q.size());
  for (Eigen::Index k = 1; k < q.size(); ++k)
    distance[k] = signal[k] * signal[k - 1] < 0.0 ? 0.0 : distance[k - 1] + std::abs(q[k] - q[k - 1]);
  return distance;
}

// at every sample of the first strip
MotionAxes axes_of(FittedModel const& by) {
  Strip const& strip = by.fitted->strips().front();
  Motion const& motion = strip.motion;
  MotionAxes axes{motion.time_s, motion.q, motion.dq, motion.ddq, {}, torque_by(by, parameters_of(by)), {}, {}};
  axes.load_torque = by.fitted->on().baseline(0).load_torque;
  axes.since_velocity_reversal = distance_since(strip.direction, motion.q);
  axes.since_torque_reversal = distance_since(axes.model_torque, motion.q);
  return axes;
}

// of the regressor alone, at every sample of the first strip
Eigen::MatrixXd own_columns(FittedModel const& by) {
  Strip const& strip = by.fitted->strips().front();
  Eigen::MatrixXd columns(strip.size(), static_cast<Eigen::Index>(by.model->regressor().size()));
  for (Eigen::Index k = 0; k < columns.cols(); ++k) {
    Eigen::VectorXd one = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(by.model->size()));
    one[k] = 1.0;
    columns.col(k) = torque_by(by, one);
  }
  return columns;
}

TorqueTrace trace(std::string name, Strip const& strip, Eigen::VectorXd const& before, Eigen::VectorXd const& after) {
  auto const& filter = *strip.filters->effects;
  auto const every = [&](Eigen::VectorXd const& signal) {
    Eigen::VectorXd const kept = filter.pick(signal);
    Eigen::VectorXd thinned((kept.size() + strip.rows_apart - 1) / strip.rows_apart);
    for (Eigen::Index k = 0; k < thinned.size(); ++k) thinned[k] = kept[k * strip.rows_apart];
    return thinned;
  };
  TorqueTrace trace;
  trace.recording = std::move(name);
  trace.time_s = every(strip.motion.time_s);
  trace.velocity = every(strip.motion.dq);
  trace.position = every(strip.motion.q);
  Eigen::VectorXd const torque = filter.apply_columns(strip.torque).col(0);
  trace.torque.resize(trace.time_s.size());
  for (Eigen::Index k = 0; k < trace.torque.size(); ++k) trace.torque[k] = torque[k * strip.rows_apart];
  trace.rate_hz = trace.time_s.size() > 1 ? 1.0 / (trace.time_s[1] - trace.time_s[0]) : 0.0;
  trace.before = trace.after = Eigen::VectorXd::Constant(trace.time_s.size(), unknown);
  for (std::size_t i = 0; i < strip.rows.size(); ++i) {
    Eigen::Index const at = strip.rows[i] / strip.rows_apart;
    if (strip.rows[i] % strip.rows_apart != 0 || at >= trace.before.size()) continue;
    trace.before[at] = before[static_cast<Eigen::Index>(i)];
    trace.after[at] = after[static_cast<Eigen::Index>(i)];
  }
  return trace;
}

}  // namespace

MismatchRows mismatch_rows(FittedModel const& by, Eigen::MatrixXd const& replicates) {
  Strip const& strip = by.fitted->strips().front();
  auto const& filter = *strip.filters->effects;
  MismatchRows rows;
  static_cast<MotionAxes&>(rows) = axes_of(by).picked(
      [&](Eigen::VectorXd const& signal) { return Eigen::VectorXd(filter.pick(signal)(strip.rows)); });
  rows.rate_hz = filter.kept_rate_hz() / static_cast<double>(strip.rows_apart);
  for (Eigen::Index const row : strip.rows) rows.kept_rows.push_back(row / strip.rows_apart);
  rows.torque = on_rows(strip, strip.torque).col(0);
  rows.residual = by.fitted->residual().head(static_cast<Eigen::Index>(strip.rows.size()));
  rows.replicates = replicates;
  rows.replicate_mean = replicates.rowwise().mean();
  return rows;
}

std::vector<MapAxis> map_of(JointDecision const& decision, int threads) {
  if (decision.baseline_replicates.cols() < fewest_replicates) return {};
  JointScales const& scales = decision.baseline.model->reference().scales;
  auto map = mismatch_map(mismatch_rows(decision.baseline, decision.baseline_replicates), scales, threads);
  if (!decision.final.model->effects().empty())
    add_after(map, mismatch_rows(decision.final, decision.final_replicates), threads);
  return map;
}

EffectAccount account_of(JointDecision const& decision, MismatchRows const& rows, std::size_t i) {
  FittedModel const& by = decision.final;
  Strip const& strip = by.fitted->strips().front();
  auto const& shaped = by.model->effects()[i];
  Regressor const& regressor = by.model->regressor();
  std::vector<Eigen::Index> samples;
  for (Eigen::Index k = 0; k < strip.size(); ++k)
    if (shaped.effect->parity() != Parity::odd || strip.is_quiet[static_cast<std::size_t>(k)] == 0)
      samples.push_back(k);
  if (samples.empty()) samples.push_back(0);
  Eigen::VectorXd const alone = effect_alone(by, i);
  Eigen::VectorXd const torque = beside_the_level(regressor, *shaped.effect, own_columns(by), torque_by(by, alone));
  Eigen::MatrixXd const columns = by.fitted->chosen().fit.columns.topRows(static_cast<Eigen::Index>(strip.rows.size()));
  Eigen::MatrixXd const own = columns.leftCols(static_cast<Eigen::Index>(regressor.size()));
  Eigen::VectorXd const whole = columns.leftCols(alone.size()) * alone;
  return account_of(EffectOnRecording{
      shaped, by.model->reference().scales,
      axes_of(by).picked([&](Eigen::VectorXd const& all) { return Eigen::VectorXd(all(samples)); }), torque(samples),
      beside_columns(own, whole), beside_the_level(regressor, *shaped.effect, own, whole), rows});
}

std::vector<TorqueTrace> traces_of(JointDecision const& decision, DecisionQuestion const& question) {
  bool const predicts = !decision.rows.validation.empty();
  auto const& strips = predicts ? decision.rows.validation : *decision.rows.training;
  auto const recordings = predicts ? question.validation : question.training;
  std::vector<TorqueTrace> traces;
  for (std::size_t i = 0; i < strips.size(); ++i)
    traces.push_back(trace(recordings[i].name, strips[i], predicted(decision.baseline, strips[i]).residual,
                           predicted(decision.final, strips[i]).residual));
  return traces;
}

std::vector<double> energies_of(FittedModel const& by, Eigen::MatrixXd const& replicates) {
  double const own = by.fitted->residual().head(replicates.rows()).squaredNorm();
  std::vector<double> energies;
  for (auto const& one : replicates.colwise()) energies.push_back(one.squaredNorm() / own);
  return energies;
}

Budget budget_of(JointDecision const& decision, double parameter_share) {
  double const before = decision.baseline.fitted->residual().squaredNorm();
  double const after = decision.final.fitted->residual().squaredNorm();
  auto const rows = decision.final_replicates.rows();
  double const own = decision.final.fitted->residual().head(rows).squaredNorm();
  double const by_chance =
      decision.final_replicates.cols() > 0 ? decision.final_replicates.colwise().squaredNorm().mean() / own : 1.0;
  Budget budget;
  double const of_model = 1.0 - parameter_share, left = std::clamp(after / before, 0.0, 1.0);
  budget.parameter_error = parameter_share;
  budget.missing_physics = of_model * (1.0 - left);
  budget.noise = of_model * left * std::min(1.0, by_chance);
  budget.unexplained = of_model * left - budget.noise;
  return budget;
}

}  // namespace torquescope
