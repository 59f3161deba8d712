#include "concealed/baseline_fit.hpp"

#include <cmath>

#include "concealed/least_squares.hpp"

namespace concealed {

BaselineFit fit_baseline(Truth const& truth, bool with_gravity) {
  bool forwards = false, backwards = false;
  for (std::size_t k = 0; k < truth.t.size(); ++k) {
    if (truth.moves[k]) (truth.seen_v[k] > 0.0 ? forwards : backwards) = true;
  }
  bool const both = forwards && backwards;
  std::vector<std::vector<double>> columns(both ? 4 : 3);
  if (with_gravity) columns.resize(columns.size() + 2);
  std::vector<double> torque;
  for (std::size_t k = 0; k < truth.t.size(); ++k) {
    if (!truth.moves[k]) continue;
    auto column = columns.begin();
    (column++)->push_back(truth.seen_a[k]);
    (column++)->push_back(truth.seen_v[k]);
    if (both) (column++)->push_back(truth.seen_v[k] > 0.0 ? 1.0 : -1.0);
    (column++)->push_back(1.0);
    if (with_gravity) {
      (column++)->push_back(std::sin(truth.seen_q[k]));
      column->push_back(std::cos(truth.seen_q[k]));
    }
    torque.push_back(truth.seen_motor[k]);
  }
  auto answer = least_squares(std::move(columns), std::move(torque));
  if (!both) answer.insert(answer.begin() + 2, 0.0);
  BaselineFit fit;
  fit.parameters = {
      answer[0], answer[1], answer[2], answer[3], with_gravity ? answer[4] : 0.0, with_gravity ? answer[5] : 0.0};
  fit.residual = baseline_residual(truth, fit.parameters);
  return fit;
}

std::vector<double> baseline_residual(Truth const& truth, Baseline const& fitted) {
  std::vector<double> residual(truth.t.size(), 0.0);
  for (std::size_t k = 0; k < residual.size(); ++k) {
    if (!truth.moves[k]) continue;
    double const model = fitted.inertia * truth.seen_a[k] + fitted.viscous * truth.seen_v[k] +
                         (truth.seen_v[k] > 0.0 ? fitted.coulomb : -fitted.coulomb) + fitted.offset +
                         fitted.gravity_sin * std::sin(truth.seen_q[k]) +
                         fitted.gravity_cos * std::cos(truth.seen_q[k]);
    residual[k] = truth.seen_motor[k] - model;
  }
  return residual;
}

}  // namespace concealed
