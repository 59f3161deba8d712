#include "engine/fit/problem/sufficient_statistics.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <optional>

#include "engine/base/contract.hpp"
#include "engine/base/dense_solvers.hpp"
#include "kernels/aligned_doubles.hpp"
#include "kernels/gram.hpp"

namespace torquescope {
namespace {

using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

// a first centre misses the minimum by the rounding of phi'phi, the next one hardly; more do not help
constexpr int most_sweeps = 4;
constexpr double negligible_gain = 1e-6;

kernels::SampleColumns columns_of(Eigen::MatrixXd const& phi, Eigen::VectorXd const& tau) {
  return {phi.data(), static_cast<std::size_t>(phi.outerStride()), tau.data(), static_cast<std::size_t>(phi.rows()),
          static_cast<std::size_t>(phi.cols())};
}

// cross products of columns and torque, or of what whitening makes of them
struct Products {
  Eigen::MatrixXd phi_phi;
  Eigen::VectorXd phi_tau;
  double tau_tau;
};

Products products_of(RowMajor const& sums) {
  auto const n = sums.rows() - 1;
  return {sums.topLeftCorner(n, n), sums.col(n).head(n), sums(n, n)};
}

class Sweeps {
 public:
  Sweeps(Eigen::MatrixXd const& phi, Eigen::VectorXd const& tau)
      : samples_(columns_of(phi, tau)),
        workspace_(kernels::gram_workspace_size(samples_.n_samples, samples_.n_regressors)),
        sums_(phi.cols() + 1, phi.cols() + 1) {}

  Products plain() {
    kernels::gram(samples_, sums_.data(), workspace_.data());
    return products_of(sums_);
  }
  Products whitened(RowMajor const& root, Eigen::VectorXd const& centre) {
    kernels::whitened_gram(samples_, root.data(), centre.data(), sums_.data(), workspace_.data());
    return products_of(sums_);
  }

 private:
  kernels::SampleColumns samples_;
  kernels::AlignedDoubles workspace_;
  RowMajor sums_;
};

// upper triangular root with root' root = products, by way of columns of length one; empty when it has none
std::optional<RowMajor> root_of(Eigen::MatrixXd const& products) {
  Eigen::VectorXd const length = products.diagonal().cwiseSqrt();
  if (!length.allFinite() || !(length.array() > 0.0).all()) return {};
  Eigen::VectorXd const inverse = length.cwiseInverse();
  auto const cholesky = cholesky_of(inverse.asDiagonal() * products * inverse.asDiagonal());
  if (!cholesky) return {};
  return RowMajor(cholesky->lower().transpose() * length.asDiagonal());
}

// (root' root)^-1 right
Eigen::VectorXd solve_root(RowMajor const& root, Eigen::VectorXd right) {
  root.transpose().triangularView<Eigen::Lower>().solveInPlace(right);
  root.triangularView<Eigen::Upper>().solveInPlace(right);
  return right;
}

// high + low = left right, all upper triangular. Along a weak direction the rows of the root cancel, and what rounding
// takes from them would be left: a double holds 53 bits of each, these two 64
void multiply(RowMajor const& left, RowMajor const& right, RowMajor& high, RowMajor& low) {
  auto const n = left.rows();
  high = low = RowMajor::Zero(n, n);
  for (Eigen::Index i = 0; i < n; ++i) {
    for (Eigen::Index j = i; j < n; ++j) {
      long double sum = 0.0L;
      for (Eigen::Index k = i; k <= j; ++k)
        sum += static_cast<long double>(left(i, k)) * static_cast<long double>(right(k, j));
      high(i, j) = static_cast<double>(sum);
      low(i, j) = static_cast<double>(sum - static_cast<long double>(high(i, j)));
    }
  }
}

// largest over smallest singular value, columns of length one
double scaled_condition(RowMajor const& root) {
  Eigen::VectorXd const inverse = root.colwise().norm().cwiseInverse();
  Eigen::MatrixXd const scaled = root * inverse.asDiagonal();
  Eigen::VectorXd const values = singular_values_of_square(scaled);
  return values[0] / values[values.size() - 1];
}

}  // namespace

SufficientStatistics::SufficientStatistics(Eigen::MatrixXd const& phi, Eigen::VectorXd const& tau)
    : noise_share_(std::numeric_limits<double>::quiet_NaN()), condition_(std::numeric_limits<double>::infinity()) {
  TORQUESCOPE_EXPECT(phi.rows() == tau.size());
  if (phi.rows() <= phi.cols()) {
    refusal_ = fmt::format("{} samples are too few for {} parameters", phi.rows(), phi.cols());
  } else if (!solve(phi, tau)) {
    refusal_ = "columns are dependent to rounding";
  } else if (!(condition_ <= largest_condition)) {
    refusal_ = fmt::format("condition number {:.1e} is above {:.0e}", condition_, largest_condition);
  } else if (!(noise_share_ >= least_noise_share)) {
    refusal_ = fmt::format("least squared error is {:.1e} of the torque's mean square, below {:.0e}", noise_share_,
                           least_noise_share);
  }
}

bool SufficientStatistics::solve(Eigen::MatrixXd const& phi, Eigen::VectorXd const& tau) {
  Sweeps sweeps(phi, tau);
  auto const plain = sweeps.plain();
  auto root = root_of(plain.phi_phi);
  if (!root) return false;
  centre_ = solve_root(*root, plain.phi_tau);

  // each sweep describes the error around the centre it was given
  for (int sweep = 1; sweep < most_sweeps; ++sweep) {
    auto const white = sweeps.whitened(*root, centre_);
    auto const refinement = root_of(white.phi_phi);
    if (!refinement) return false;
    Eigen::VectorXd const step = solve_root(*refinement, white.phi_tau);  // to the minimum, in whitened parameters
    double const gain = step.dot(white.phi_tau);
    RowMajor const before = *root;
    multiply(*refinement, before, root_, root_low_);
    slope_ = before.transpose() * white.phi_tau;
    constant_ = white.tau_tau;
    noise_share_ = (constant_ - gain) / plain.tau_tau;
    if (!(gain > negligible_gain * constant_) || sweep + 1 == most_sweeps) break;
    centre_ += before.triangularView<Eigen::Upper>().solve(step);
    root = root_;
  }
  condition_ = scaled_condition(root_);
  return root_.allFinite() && centre_.allFinite();
}

kernels::QuadraticForm SufficientStatistics::form() const {
  TORQUESCOPE_EXPECT(usable());
  return {static_cast<std::size_t>(centre_.size()),
          centre_.data(),
          root_.data(),
          root_low_.data(),
          slope_.data(),
          constant_};
}

}  // namespace torquescope
