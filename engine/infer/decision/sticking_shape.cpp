#include "engine/infer/decision/sticking_shape.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace torquescope {
namespace {

constexpr double most_ratio = 5.0;  // from one size to the next, at the most
constexpr double widest = 100.0;    // from the smallest to the largest: what is smaller is the sign itself

std::vector<double> sizes(double least, double most) {
  double const from = std::max(least, most / widest);
  auto const steps = std::max(1.0, std::ceil(std::log(most / from) / std::log(most_ratio)));
  std::vector<double> all;
  for (double k = 0.0; k <= steps; k += 1.0) all.push_back(from * std::pow(most / from, k / steps));
  return all;
}

Eigen::VectorXd built_up(Eigen::VectorXd const& q, double before, double length) {
  Eigen::VectorXd bent(q.size());
  double now = before;
  for (Eigen::Index k = 0; k < q.size(); ++k) {
    double const way = k > 0 ? q[k] - q[k - 1] : 0.0, side = way > 0.0 ? 1.0 : way < 0.0 ? -1.0 : 0.0;
    if (side != 0.0) now = side + (now - side) * std::exp(-std::abs(way) / length);
    bent[k] = now;
  }
  return bent;
}

}  // namespace

StickingBounds sticking_bounds(double resolution) {
  constexpr double least_creep = 1e-4, most_creep = 2e-2;             // rad/s, m/s
  constexpr double least_steps_per_s = 0.1, most_steps_per_s = 10.0;  // the same for a coarse encoder
  constexpr double least_steps = 0.5, most_steps = 3.0, most_length = 5e-3;
  return {std::max(least_creep, least_steps_per_s * resolution), std::max(most_creep, most_steps_per_s * resolution),
          least_steps * resolution, std::max(most_length, most_steps * resolution)};
}

StickingSizes sticking_sizes(StickingBounds const& bounds) {
  return {sizes(bounds.least_creep, bounds.most_creep), sizes(bounds.least_length, bounds.most_length)};
}

void each_sticking_side(Eigen::VectorXd const& q, Eigen::VectorXd const& dq, Eigen::VectorXd const& direction,
                        StickingBounds const& bounds, std::function<void(Eigen::VectorXd const&)> const& take) {
  StickingSizes const sizes = sticking_sizes(bounds);
  for (double const creep : sizes.creeps) take((dq / creep).array().tanh());
  for (double const length : sizes.lengths) take(built_up(q, direction[0], length));
}

}  // namespace torquescope
