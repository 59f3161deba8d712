#include "engine/fit/statistics/essential_parameters.hpp"

#include <cmath>
#include <limits>
#include <numeric>
#include <optional>

#include "engine/base/contract.hpp"
#include "engine/base/dense_solvers.hpp"

namespace torquescope {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double dependent = 1e-10;  // of a unit column's square that the columns before it leave

struct Fit {
  VectorXd values, errors;
  double residual_energy;
};

// columns of length one before anything is divided; nothing when they depend on each other
std::optional<Fit> fit_of(MatrixXd const& gram, std::vector<Index> const& kept, Index rows) {
  Index const torque = gram.cols() - 1, n = static_cast<Index>(kept.size());
  VectorXd const lengths = gram(kept, kept).diagonal().cwiseSqrt();
  if (n > 0 && !(lengths.minCoeff() > 0.0)) return std::nullopt;
  VectorXd const scale = lengths.cwiseInverse();
  MatrixXd const unit = scale.asDiagonal() * gram(kept, kept) * scale.asDiagonal();
  auto const factor = cholesky_of(unit);
  if (!factor || (n > 0 && factor->lower().diagonal().cwiseAbs2().minCoeff() < dependent)) return std::nullopt;
  VectorXd const right = scale.cwiseProduct(gram(kept, torque));
  VectorXd const solved = factor->solve(right);
  Fit fit;
  fit.residual_energy = std::max(0.0, gram(torque, torque) - solved.dot(right));
  double const variance = fit.residual_energy / static_cast<double>(rows - n);
  MatrixXd const inverse = factor->solve(MatrixXd(MatrixXd::Identity(n, n)));
  fit.values = scale.cwiseProduct(solved);
  fit.errors = scale.cwiseProduct((variance * inverse.diagonal()).cwiseSqrt());
  return fit;
}

// the first column, from the last on, that those before it make up
std::size_t dependent_column(MatrixXd const& gram, std::vector<Index> const& kept, Index rows) {
  for (std::size_t n = 1; n <= kept.size(); ++n)
    if (!fit_of(gram, {kept.begin(), kept.begin() + static_cast<std::ptrdiff_t>(n)}, rows)) return n - 1;
  return kept.size() - 1;
}

}  // namespace

EssentialParameters essential_parameters(MatrixXd const& gram, Index rows, double ratio) {
  TORQUESCOPE_EXPECT(gram.rows() == gram.cols() && gram.cols() >= 1 && rows >= gram.cols() && ratio >= 1.0);
  EssentialParameters found;
  found.kept.resize(static_cast<std::size_t>(gram.cols() - 1));
  std::iota(found.kept.begin(), found.kept.end(), Index{0});
  auto const drop = [&](std::size_t at) {
    found.dropped.push_back(found.kept[at]);
    found.kept.erase(found.kept.begin() + static_cast<std::ptrdiff_t>(at));
  };
  for (;;) {
    auto const fit = fit_of(gram, found.kept, rows);
    if (!fit) {
      drop(dependent_column(gram, found.kept, rows));
      continue;
    }
    found.values = fit->values;
    found.standard_errors = fit->errors;
    found.residual_energy = fit->residual_energy;
    if (found.kept.size() < 2) return found;
    VectorXd const relative = fit->errors.cwiseQuotient(fit->values.cwiseAbs());
    Index worst = 0;
    double const largest = relative.maxCoeff(&worst);
    if (!(largest > ratio * relative.minCoeff())) return found;
    drop(static_cast<std::size_t>(worst));
  }
}

}  // namespace torquescope
