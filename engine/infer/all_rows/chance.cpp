#include "engine/infer/all_rows/chance.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "engine/base/contract.hpp"

namespace torquescope {

double value_of_chance(std::vector<double> values, double alpha) {
  std::sort(values.begin(), values.end());
  auto const place = static_cast<std::size_t>(std::ceil((1.0 - alpha) * static_cast<double>(values.size() + 1)));
  return values[std::min(values.size(), std::max<std::size_t>(1, place)) - 1];
}

void Chance::add(Eigen::MatrixXd const& further) {
  if (gains.cols() == 0) {
    gains = further;
    return;
  }
  TORQUESCOPE_EXPECT(further.rows() == gains.rows());
  gains.conservativeResize(Eigen::NoChange, gains.cols() + further.cols());
  gains.rightCols(further.cols()) = further;
}

std::vector<double> Chance::largest() const {
  Eigen::Index const m = gains.cols();
  Eigen::ArrayXd const sum = gains.rowwise().sum().array();
  std::vector<double> largest;
  for (Eigen::Index t = 0; t < m; ++t) {
    Eigen::ArrayXd const of_others = (sum - gains.col(t).array()) / static_cast<double>(m - 1);
    largest.push_back((gains.col(t).array() / (1.0 + of_others)).maxCoeff());
  }
  return largest;
}

Eigen::VectorXd Chance::relative(Eigen::VectorXd const& gains_of_recording) const {
  return (gains_of_recording.array() / (1.0 + gains.rowwise().mean().array())).matrix();
}

Eigen::VectorXd Chance::p(Eigen::VectorXd const& gains_of_recording) const {
  TORQUESCOPE_EXPECT(gains.cols() > 1 && gains_of_recording.size() == gains.rows());
  if (gains.rows() == 0) return {};
  auto const all = largest();
  Eigen::VectorXd const here = relative(gains_of_recording);
  Eigen::VectorXd p(gains.rows());
  for (Eigen::Index law = 0; law < p.size(); ++law) {
    auto const reached = std::count_if(all.begin(), all.end(), [&](double one) { return one >= here[law]; });
    p[law] = (1.0 + static_cast<double>(reached)) / (static_cast<double>(all.size()) + 1.0);
  }
  return p;
}

Eigen::VectorXd Chance::needed(double alpha) const {
  TORQUESCOPE_EXPECT(gains.cols() > 1 && gains.rows() > 0);
  return (1.0 + gains.rowwise().mean().array()) * value_of_chance(largest(), alpha);
}

Eigen::VectorXd Chance::level(double alpha) const {
  Eigen::VectorXd level(gains.rows());
  for (Eigen::Index law = 0; law < level.size(); ++law) {
    Eigen::VectorXd const of_law = gains.row(law).transpose();
    level[law] = value_of_chance({of_law.begin(), of_law.end()}, alpha);
  }
  return level;
}

}  // namespace torquescope
