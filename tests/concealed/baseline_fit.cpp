#include "concealed/baseline_fit.hpp"

#include <cmath>

#include "concealed/least_squares.hpp"

namespace concealed {

BaselineFit fit_baseline(Truth const& truth, bool with_gravity) {
  std::vector<std::vector<double>> columns(with_gravity ? 6 : 4);
  std::vector<double> torque;
  for (std::size_t k = 0; k < truth.t.size(); ++k) {
    if (!truth.moves[k]) continue;
    columns[0].push_back(truth.a[k]);
    columns[1].push_back(truth.v[k]);
    columns[2].push_back(truth.v[k] > 0.0 ? 1.0 : -1.0);
    columns[3].push_back(1.0);
    if (with_gravity) {
      columns[4].push_back(std::sin(truth.q[k]));
      columns[5].push_back(std::cos(truth.q[k]));
    }
    torque.push_back(truth.motor[k]);
  }
  auto const answer = least_squares(std::move(columns), std::move(torque));
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
    double const model = fitted.inertia * truth.a[k] + fitted.viscous * truth.v[k] +
                         (truth.v[k] > 0.0 ? fitted.coulomb : -fitted.coulomb) + fitted.offset +
                         fitted.gravity_sin * std::sin(truth.q[k]) + fitted.gravity_cos * std::cos(truth.q[k]);
    residual[k] = truth.motor[k] - model;
  }
  return residual;
}

}  // namespace concealed
