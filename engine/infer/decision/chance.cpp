#include "engine/infer/decision/chance.hpp"

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

namespace {

// what each effect's D is counted in, from the mean squares of its D in replicates
Eigen::ArrayXd units_of(Eigen::ArrayXd const& mean_squares) {
  constexpr double one_parameter = 3.84;  // chi-squared of one degree of freedom, 95 %
  return one_parameter + mean_squares.max(0.0).sqrt();
}

Eigen::ArrayXd units_in(Eigen::MatrixXd const& gains) { return units_of(gains.array().square().rowwise().mean()); }

}  // namespace

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
  Eigen::ArrayXd const squares = gains.array().square().rowwise().sum();
  std::vector<double> largest;
  for (Eigen::Index t = 0; t < m; ++t) {
    Eigen::ArrayXd const own = gains.col(t).array();
    largest.push_back((own / units_of((squares - own.square()) / static_cast<double>(m - 1))).maxCoeff());
  }
  return largest;
}

Eigen::VectorXd Chance::relative(Eigen::VectorXd const& gains_of_recording) const {
  return (gains_of_recording.array() / units_in(gains)).matrix();
}

Eigen::VectorXd Chance::p(Eigen::VectorXd const& gains_of_recording) const {
  TORQUESCOPE_EXPECT(gains.cols() > 1 && gains_of_recording.size() == gains.rows());
  if (gains.rows() == 0) return {};
  auto const all = largest();
  Eigen::VectorXd const here = relative(gains_of_recording);
  Eigen::VectorXd p(gains.rows());
  for (Eigen::Index effect = 0; effect < p.size(); ++effect) {
    auto const reached = std::count_if(all.begin(), all.end(), [&](double one) { return one >= here[effect]; });
    p[effect] = (1.0 + static_cast<double>(reached)) / (static_cast<double>(all.size()) + 1.0);
  }
  return p;
}

Eigen::VectorXd Chance::needed(double alpha) const {
  TORQUESCOPE_EXPECT(gains.cols() > 1 && gains.rows() > 0);
  return units_in(gains) * value_of_chance(largest(), alpha);
}

Eigen::VectorXd Chance::level(double alpha) const {
  Eigen::VectorXd level(gains.rows());
  for (Eigen::Index effect = 0; effect < level.size(); ++effect) {
    Eigen::VectorXd const of_effect = gains.row(effect).transpose();
    level[effect] = value_of_chance({of_effect.begin(), of_effect.end()}, alpha);
  }
  return level;
}

}  // namespace torquescope
