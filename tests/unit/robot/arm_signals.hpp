#pragma once
// Random motions of an arm with torques and weights: the input of rows and products.

#include <Eigen/Core>
#include <random>
#include <vector>

#include "engine/robot/arm_rows.hpp"

namespace torquescope::test {

// n_samples x joints each; every seventh weight is 0, and some speeds are
struct ArmSignals {
  Eigen::MatrixXd q, dq, ddq, tau, root_weight;

  ArmSignals(Eigen::Index n_samples, Eigen::Index joints, unsigned seed) {
    std::mt19937 bits(seed);
    std::uniform_real_distribution<double> uniform(-3.0, 3.0);
    auto const draw = [&] {
      return Eigen::MatrixXd::NullaryExpr(n_samples, joints, [&](Eigen::Index, Eigen::Index) { return uniform(bits); })
          .eval();
    };
    q = draw(), dq = draw(), ddq = draw(), tau = draw();
    root_weight = draw().cwiseAbs();
    for (Eigen::Index t = 0; t < n_samples; ++t) {
      if (t % 7 == 3) root_weight.row(t).setZero();
      if (t % 5 == 2) dq(t, t % joints) = 0.0;
    }
  }

  std::vector<JointSamples> samples(Eigen::Index first, Eigen::Index count) const {
    std::vector<JointSamples> all;
    auto const part = [&](Eigen::MatrixXd const& signal, Eigen::Index joint) {
      return std::span<double const>(signal.data() + joint * signal.rows() + first, static_cast<std::size_t>(count));
    };
    for (Eigen::Index j = 0; j < q.cols(); ++j)
      all.push_back({part(q, j), part(dq, j), part(ddq, j), part(tau, j), part(root_weight, j)});
    return all;
  }
  std::vector<JointSamples> samples() const { return samples(0, q.rows()); }
};

}  // namespace torquescope::test
