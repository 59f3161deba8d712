#include "engine/excite/motion_quality.hpp"

#include <Eigen/Eigenvalues>
#include <cmath>
#include <limits>

#include "engine/base/contract.hpp"

namespace torquescope {

MotionQuality motion_quality(RowModel const& model, MotionSamples const& samples) {
  using Eigen::Index;
  Eigen::MatrixXd gram = Eigen::MatrixXd::Zero(model.size, model.size);
  auto const rows = model.rows(samples);
  TORQUESCOPE_EXPECT(rows.size() == model.own.size());
  for (std::size_t j = 0; j < rows.size(); ++j) {
    double const noise = model.noise[static_cast<Index>(j)];
    gram(model.own[j], model.own[j]) += rows[j].transpose() * rows[j] / (noise * noise);
  }

  // eigenvalues of the Gram of columns of length one are the squared singular values
  constexpr double infinite = std::numeric_limits<double>::infinity();
  Eigen::VectorXd const squares = gram.diagonal();
  if (!(squares.minCoeff() > 0.0) || !squares.allFinite()) return {infinite, -infinite};
  Eigen::VectorXd const scale = squares.cwiseSqrt().cwiseInverse();
  Eigen::MatrixXd const scaled = scale.asDiagonal() * gram * scale.asDiagonal();
  Eigen::VectorXd const values =
      Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(scaled, Eigen::EigenvaluesOnly).eigenvalues();
  double const rounding = std::numeric_limits<double>::epsilon() * static_cast<double>(model.size) * values.maxCoeff();
  if (values.minCoeff() <= rounding) return {infinite, -infinite};
  double const logarithms = values.array().log().sum() + squares.array().log().sum();
  return {std::sqrt(values.maxCoeff() / values.minCoeff()), logarithms / static_cast<double>(model.size)};
}

}  // namespace torquescope
