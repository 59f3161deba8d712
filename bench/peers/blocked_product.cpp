// DE around a matrix library: phi times the whole population in blocks that stay in L1, then the squares of the
// differences to the torque. Blocks of 128 samples were the fastest of 32 to 512 for both libraries.

#include <cblas.h>

#include <Eigen/Core>

#include "bench/peers/differential_evolution.hpp"

namespace peers {
namespace {

constexpr std::size_t block = 128;

using Matrix = Eigen::MatrixXd;
using Part = Eigen::Map<Matrix const, 0, Eigen::OuterStride<>>;
using Torque = Eigen::Map<Eigen::VectorXd const>;

Eigen::Index index(std::size_t i) { return static_cast<Eigen::Index>(i); }

// product(first sample, how many, members, predictions [samples x members])
template <class Product>
double search(Problem const& problem, unsigned seed, Product&& product) {
  Matrix predictions(index(block), n_members);
  return differential_evolution(problem, seed, [&](double const* members, double* mse) {
    Eigen::Map<Eigen::RowVectorXd> sums(mse, n_members);
    sums.setZero();
    for (std::size_t first = 0; first < problem.n; first += block) {
      std::size_t const count = std::min(block, problem.n - first);
      product(first, count, members, predictions);
      Torque const tau(problem.tau.data() + first, index(count));
      // column by column: colwise() over all of them is not vectorised, and twice as slow
      for (Eigen::Index m = 0; m < sums.size(); ++m)
        sums[m] += (predictions.col(m).head(index(count)) - tau).squaredNorm();
    }
    sums /= static_cast<double>(problem.n);
  });
}

}  // namespace

double openblas_de(Problem const& problem, unsigned seed) {
  auto const n = static_cast<int>(problem.n), R = static_cast<int>(problem.R);
  return search(problem, seed, [&](std::size_t first, std::size_t count, double const* members, Matrix& predictions) {
    cblas_dgemm(CblasColMajor, CblasNoTrans, CblasNoTrans, static_cast<int>(count), static_cast<int>(n_members), R, 1.0,
                problem.phi.data() + first, n, members, R, 0.0, predictions.data(), static_cast<int>(block));
  });
}

double eigen_de(Problem const& problem, unsigned seed) {
  auto const n = index(problem.n), R = index(problem.R);
  return search(problem, seed, [&](std::size_t first, std::size_t count, double const* members, Matrix& predictions) {
    Part const phi(problem.phi.data() + first, index(count), R, Eigen::OuterStride<>(n));
    predictions.topRows(index(count)).noalias() = phi * Eigen::Map<Matrix const>(members, R, n_members);
  });
}

}  // namespace peers
