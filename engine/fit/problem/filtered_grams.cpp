#include "engine/fit/problem/filtered_grams.hpp"

#include <cmath>
#include <optional>

#include "engine/base/dense_solvers.hpp"

namespace torquescope {
namespace {

// [columns torque] of one joint in one recording; the only place that touches rows
void add_rows(JointRows const& rows, Eigen::MatrixXd& gram) {
  Eigen::Index const own = rows.columns.cols();
  gram.topLeftCorner(own, own).noalias() += rows.columns.transpose() * rows.columns;
  gram.topRightCorner(own, 1).noalias() += rows.columns.transpose() * rows.torque;
  gram(own, own) += rows.torque.squaredNorm();
}

// argmin of the pooled squares; nothing where they cannot tell
std::optional<Eigen::VectorXd> pooled_solution(std::vector<FilteredGram> const& grams, Eigen::Index n_parameters,
                                               Eigen::VectorXd const& variance) {
  auto const [information, right] = pooled_squares(grams, n_parameters, variance);
  Eigen::VectorXd const length = information.diagonal().cwiseSqrt();
  if (!(length.minCoeff() > 0.0)) return {};
  Eigen::VectorXd const scale = length.cwiseInverse();
  Eigen::MatrixXd const scaled = scale.asDiagonal() * information * scale.asDiagonal();
  auto const root = cholesky_of(scaled);
  if (!root) return {};
  Eigen::VectorXd const solution = scale.asDiagonal() * root->solve(Eigen::VectorXd(scale.asDiagonal() * right));
  if (!solution.allFinite()) return {};
  return solution;
}

}  // namespace

PooledSquares pooled_squares(std::vector<FilteredGram> const& grams, Eigen::Index n_parameters,
                             Eigen::VectorXd const& variance) {
  PooledSquares pooled{Eigen::MatrixXd::Zero(n_parameters, n_parameters), Eigen::VectorXd::Zero(n_parameters)};
  for (std::size_t j = 0; j < grams.size(); ++j) {
    auto const& own = grams[j].parameters;
    auto const count = static_cast<Eigen::Index>(own.size());
    double const weight = 1.0 / variance[static_cast<Eigen::Index>(j)];
    pooled.information(own, own) += weight * grams[j].gram.topLeftCorner(count, count);
    pooled.right(own) += weight * grams[j].gram.topRightCorner(count, 1);
  }
  return pooled;
}

double FilteredGram::residual_energy(Eigen::Ref<Eigen::VectorXd const> const& all_parameters) const {
  Eigen::VectorXd x(gram.rows());
  for (std::size_t c = 0; c < parameters.size(); ++c) x[static_cast<Eigen::Index>(c)] = -all_parameters[parameters[c]];
  x[gram.rows() - 1] = 1.0;
  return x.dot(gram * x);
}

std::vector<FilteredGram> filtered_grams(std::span<RecordedRows const> recordings, ArmModel const& model) {
  std::vector<FilteredGram> grams;
  for (std::size_t j = 0; j < model.joints(); ++j) {
    FilteredGram one;
    one.parameters = model.parameters_of(j);
    auto const size = static_cast<Eigen::Index>(one.parameters.size()) + 1;
    one.gram.setZero(size, size);
    for (auto const& recording : recordings) {
      add_rows(recording.moving[j], one.gram);
      one.rows += recording.moving[j].torque.size();
    }
    one.gram.bottomLeftCorner(1, size - 1) = one.gram.topRightCorner(size - 1, 1).transpose();
    grams.push_back(std::move(one));
  }
  return grams;
}

NoiseLevels noise_levels(std::vector<FilteredGram> const& grams, Eigen::Index n_parameters) {
  constexpr double least_share = 1e-6, settled = 1e-6;
  constexpr int most_iterations = 100;
  auto const joints = static_cast<Eigen::Index>(grams.size());
  Eigen::VectorXd torque(joints), rows(joints);
  for (Eigen::Index j = 0; j < joints; ++j) {
    auto const& one = grams[static_cast<std::size_t>(j)];
    rows[j] = std::max(1.0, static_cast<double>(one.rows));
    torque[j] = one.rows > 0 && one.torque_energy() > 0.0 ? one.torque_energy() / rows[j] : 1.0;
  }
  NoiseLevels levels{torque.cwiseSqrt()};
  Eigen::VectorXd variance = torque;
  while (!levels.converged && levels.iterations < most_iterations) {
    auto const solution = pooled_solution(grams, n_parameters, variance);
    if (!solution) return levels;
    Eigen::VectorXd next(joints);
    for (Eigen::Index j = 0; j < joints; ++j)
      next[j] = std::max(grams[static_cast<std::size_t>(j)].residual_energy(*solution) / rows[j],
                         least_share * least_share * torque[j]);
    levels.converged = ((next - variance).array().abs() <= settled * variance.array()).all();
    variance = next;
    levels.deviation = variance.cwiseSqrt();
    ++levels.iterations;
  }
  return levels;
}

}  // namespace torquescope
