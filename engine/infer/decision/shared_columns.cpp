#include "engine/infer/decision/shared_columns.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/base/dense_solvers.hpp"
#include "engine/fit/statistics/scaled_solution.hpp"
#include "engine/simulate/rollout/effective_samples.hpp"

namespace torquescope {
namespace {

constexpr double told = 1e-9;  // of the largest eigenvalue of a scaled matrix: less is rounding

// axes of a positive semidefinite matrix that have anything, each divided by the root of its value: W' gram W = 1
Eigen::MatrixXd whitening(Eigen::MatrixXd const& gram) {
  Eigen::VectorXd scale = gram.diagonal().cwiseMax(0.0).cwiseSqrt();
  for (double& one : scale) one = one > 0.0 ? 1.0 / one : 0.0;
  SymmetricAxes const axes = symmetric_axes(scale.asDiagonal() * gram * scale.asDiagonal());
  double const least = told * axes.values.maxCoeff();
  std::vector<Eigen::Index> kept;
  for (Eigen::Index k = 0; k < axes.values.size(); ++k)
    if (axes.values[k] > least && axes.values[k] > 0.0) kept.push_back(k);
  Eigen::VectorXd const roots = axes.values(kept).cwiseSqrt();
  return scale.asDiagonal() * axes.vectors(Eigen::all, kept) * roots.cwiseInverse().asDiagonal();
}

}  // namespace

SharedInformation SharedInformation::none(Eigen::Index parameters) {
  return {Eigen::MatrixXd::Zero(parameters, parameters), Eigen::VectorXd::Zero(parameters)};
}

void SharedInformation::add(SharedInformation const& other) {
  gram += other.gram;
  right += other.right;
}

double independent_variance(SharedRows const& rows) {
  constexpr double least = 1e-12;  // of the torque's mean square: what fits exactly must not outweigh everything
  Eigen::MatrixXd all(rows.shared.rows(), rows.shared.cols() + rows.own.cols());
  all << rows.shared, rows.own;
  Eigen::VectorXd const left = beside_columns(all, rows.torque);
  double const floor = least * rows.torque.squaredNorm() / static_cast<double>(std::max<Eigen::Index>(1, left.size()));
  double const independent = std::max(1.0, effective_samples(left));
  return std::max({left.squaredNorm() / independent, floor, std::numeric_limits<double>::min()});
}

SharedInformation information_of(SharedRows const& rows, double variance) {
  Eigen::MatrixXd beside = rows.shared - rows.own * solve_scaled(rows.own, rows.shared);
  // a column that its joint's own ones imitate leaves rounding, which is no information; nor is a column of rounding
  double const largest = rows.shared.colwise().squaredNorm().maxCoeff();
  for (Eigen::Index k = 0; k < beside.cols(); ++k)
    if (beside.col(k).squaredNorm() <= std::max(told * rows.shared.col(k).squaredNorm(), told * told * largest))
      beside.col(k).setZero();
  return {beside.transpose() * beside / variance, beside.transpose() * rows.torque / variance};
}

Eigen::VectorXd shared_parameters(SharedInformation const& information) {
  Eigen::MatrixXd const white = whitening(information.gram);
  return white * (white.transpose() * information.right);
}

SharedPart shared_part(std::vector<SharedInformation> const& of_joints, std::size_t joint) {
  constexpr double half = 0.5;
  Eigen::Index const parameters = of_joints[joint].right.size();
  SharedInformation others = SharedInformation::none(parameters);
  for (std::size_t j = 0; j < of_joints.size(); ++j)
    if (j != joint) others.add(of_joints[j]);
  Eigen::MatrixXd const white = whitening(others.gram + of_joints[joint].gram);
  SymmetricAxes const axes = symmetric_axes(white.transpose() * of_joints[joint].gram * white);
  std::vector<Eigen::Index> free, fixed;
  for (Eigen::Index k = 0; k < axes.values.size(); ++k) (axes.values[k] > half ? free : fixed).push_back(k);
  // along fixed directions the others' information is one less the own share
  Eigen::MatrixXd const of_others = white * axes.vectors(Eigen::all, fixed);
  Eigen::VectorXd const share = 1.0 - axes.values(fixed).array();
  return {of_others * share.cwiseInverse().asDiagonal() * (of_others.transpose() * others.right),
          white * axes.vectors(Eigen::all, free)};
}

}  // namespace torquescope
