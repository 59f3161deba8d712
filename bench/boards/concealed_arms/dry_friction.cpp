#include "concealed_arms/dry_friction.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

namespace concealed_arms {
namespace {

double sign(double x) { return x > 0.0 ? 1.0 : x < 0.0 ? -1.0 : 0.0; }

}  // namespace

Eigen::VectorXd speeds_against_dry_friction(Eigen::MatrixXd const& a, Eigen::VectorXd const& r,
                                            Eigen::VectorXd const& level, Eigen::VectorXd const& before) {
  // every joint goes on in its direction: one solution of equations
  Eigen::VectorXd const way = before.unaryExpr(&sign);
  Eigen::VectorXd v = a.llt().solve(r - level.cwiseProduct(way));
  if ((way.array() != 0.0).all() && (v.array() * way.array() > 0.0).all()) return v;
  // a joint reverses or sticks
  constexpr int most_sweeps = 500;
  constexpr double enough = 1e-14;  // rad/s
  for (int sweep = 0; sweep < most_sweeps; ++sweep) {
    double change = 0.0;
    for (Eigen::Index i = 0; i < v.size(); ++i) {
      double const free = r[i] - a.row(i).dot(v) + a(i, i) * v[i];
      double const moved = sign(free) * std::max(0.0, std::abs(free) - level[i]) / a(i, i);
      change = std::max(change, std::abs(moved - v[i]));
      v[i] = moved;
    }
    if (change < enough) break;
  }
  return v;
}

}  // namespace concealed_arms
