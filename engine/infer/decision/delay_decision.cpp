#include "engine/infer/decision/delay_decision.hpp"

#include <algorithm>
#include <cmath>

#include "engine/infer/decision/score.hpp"
#include "engine/simulate/rollout/effective_samples.hpp"

namespace torquescope {
namespace {

// without the tangent of the delay, which would take it up
Eigen::VectorXd left_by(FittedStrips const& fitted) {
  Score const score(fitted.chosen().fit.columns, fitted.residual(), fitted.guard());
  return score.left_on_rows_with({}, 0);
}

}  // namespace

double allowed_delay(FittedStrips const& fitted) {
  constexpr double earliest = -0.5, latest = 1.5;  // samples
  double const sample_s = 1.0 / fitted.strips().front().filters->rate_hz;
  return std::clamp(fitted.chosen().late_s, earliest * sample_s, latest * sample_s);
}

FittedModel at_allowed_delay(JointStrips const& rows, FittedModel const& model) {
  return fitted_at(rows, *model.model, allowed_delay(*model.fitted));
}

double delay_gain(FittedStrips const& fitted, FittedStrips const& at_allowed) {
  Eigen::VectorXd const with = left_by(fitted);
  double const least = with.squaredNorm(), none = left_by(at_allowed).squaredNorm();
  return none > least && least > 0.0 ? effective_samples(with) * std::log(none / least) : 0.0;
}

DelayFacts decided_delay(DecisionQuestion const& question, JointStrips const& rows, FittedModel const& model,
                         std::span<double const> chance) {
  DelayFacts delay;
  delay.late_s = model.fitted->chosen().late_s;
  delay.deviation_s = delay_deviation(model);
  FittedModel const without = at_allowed_delay(rows, model);
  delay.gain = delay_gain(*model.fitted, *without.fitted);
  double const fall = without.fitted->residual().squaredNorm() - model.fitted->residual().squaredNorm();
  delay.size = std::sqrt(std::max(0.0, fall) / static_cast<double>(model.fitted->on().rows())) / rows.torque_rms();
  auto const reached = std::count_if(chance.begin(), chance.end(), [&](double gain) { return gain >= delay.gain; });
  delay.p = (1.0 + static_cast<double>(reached)) / (1.0 + static_cast<double>(chance.size()));
  delay.judged_without = errors_of(rows, without).judged();
  delay.is_named = delay.p <= question.numbers.alpha && delay.gain > 0.0 && delay.size >= question.numbers.delta &&
                   errors_of(rows, model).judged() < delay.judged_without;
  return delay;
}

}  // namespace torquescope
