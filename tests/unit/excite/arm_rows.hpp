#pragma once
// Rows of an arm for the tests of excite: base parameters with drives, viscous and Coulomb friction of every joint.

#include "engine/fit/excite/motion_quality.hpp"
#include "engine/robot/base_parameters.hpp"
#include "engine/robot/inverse_dynamics.hpp"
#include "unit/robot/example_arms.hpp"

namespace torquescope::test {

// the CRS A465's joints with speeds and ranges as its data sheet has them
inline SerialChain limited_crs(std::size_t joints) {
  SerialChain chain = crs_a465(joints);
  double const ranges[] = {3.05, 1.57, 1.92, 3.14, 1.83};
  for (std::size_t j = 0; j < joints; ++j) {
    chain.joints[j].lower = -ranges[j];
    chain.joints[j].upper = ranges[j];
    chain.joints[j].max_speed = 3.1;
    chain.joints[j].max_acceleration = j < 3 ? 12.5 : 25.0;
  }
  return chain;
}

inline RowModel row_model(SerialChain const& chain) {
  using Eigen::Index;
  auto const base = std::make_shared<BaseParameters const>(chain, DriveInertias::included);
  Index const n = chain.size(), n_base = base->size();
  RowModel model{n_base + 2 * n, {}, {}, Eigen::VectorXd::Ones(n)};
  for (Index j = 0; j < n; ++j) {
    std::vector<Index> own;
    for (Index k = 0; k < n_base; ++k) {
      auto const& parameter = base->parameters()[static_cast<std::size_t>(k)];
      if (parameter.first_row <= j && j <= parameter.last_row) own.push_back(k);
    }
    own.insert(own.end(), {n_base + 2 * j, n_base + 2 * j + 1});
    model.own.push_back(own);
  }
  model.rows = [chain, base, own = model.own, n, n_base](MotionSamples const& at) {
    std::vector<Eigen::MatrixXd> rows;
    for (auto const& mine : own) rows.emplace_back(at.q.rows(), static_cast<Index>(mine.size()));
    for (Index i = 0; i < at.q.rows(); ++i) {
      Eigen::MatrixXd const phi = base->pick(arm_regressor(chain, at.q.row(i).transpose(), at.dq.row(i).transpose(),
                                                           at.ddq.row(i).transpose(), DriveInertias::included));
      for (Index j = 0; j < n; ++j) {
        auto const& mine = own[static_cast<std::size_t>(j)];
        auto row = rows[static_cast<std::size_t>(j)].row(i);
        double const speed = at.dq(i, j);
        for (std::size_t c = 0; c < mine.size(); ++c)
          row[static_cast<Index>(c)] = mine[c] < n_base ? phi(j, mine[c])
                                       : (mine[c] - n_base) % 2 == 0
                                           ? speed
                                           : static_cast<double>((speed > 0.0) - (speed < 0.0));
      }
    }
    return rows;
  };
  return model;
}

}  // namespace torquescope::test
