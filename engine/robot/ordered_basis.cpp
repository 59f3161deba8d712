#include "engine/robot/ordered_basis.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace torquescope {

namespace {

using Eigen::Index;

// one that leaves less of a unit column is almost a sum: kept before others it lends them its rounding, and a dependent
// one behind it looks independent
constexpr double clear = 1e-4;

// columns taken one after the other
class GramSchmidt {
 public:
  GramSchmidt(Index rows, Index columns) : q_(rows, columns), r_(Eigen::MatrixXd::Zero(columns, columns)) {}

  // length of what the kept columns leave of this unit column; keep() or sum() refer to it
  double project(Eigen::VectorXd const& column) {
    rest_ = column;
    along_ = Eigen::VectorXd::Zero(size_);
    for (int pass = 0; pass < 2; ++pass)
      for (Index k = 0; k < size_; ++k) {
        double const part = q_.col(k).dot(rest_);
        along_[k] += part;
        rest_ -= part * q_.col(k);
      }
    return rest_.norm();
  }

  void keep() {
    double const length = rest_.norm();
    r_.col(size_).head(size_) = along_;
    r_(size_, size_) = length;
    q_.col(size_) = rest_ / length;
    ++size_;
  }

  // factors of the kept columns
  Eigen::VectorXd sum() const {
    Eigen::VectorXd factors = along_;
    for (Index k = size_ - 1; k >= 0; --k) {
      factors[k] /= r_(k, k);
      factors.head(k) -= factors[k] * r_.col(k).head(k);
    }
    return factors;
  }

 private:
  Eigen::MatrixXd q_, r_;
  Eigen::VectorXd rest_, along_;
  Index size_ = 0;
};

}  // namespace

OrderedBasis ordered_basis(Eigen::MatrixXd const& columns, std::vector<Index> const& order, double tolerance) {
  Eigen::VectorXd const lengths = columns.colwise().norm();
  double const shortest = 1e-12 * lengths.maxCoeff();
  GramSchmidt basis(columns.rows(), columns.cols());
  OrderedBasis result;
  std::vector<Index> taken;  // in the order they were kept
  Eigen::MatrixXd sums = Eigen::MatrixXd::Zero(columns.cols(), columns.cols());
  std::vector<Index> almost;  // a sum of the kept ones: they wait until the clear ones stand
  auto const keep_or_sum = [&](Index column, double enough) {
    double const rest = basis.project(columns.col(column) / lengths[column]);
    if (rest > enough) {
      basis.keep();
      sums(static_cast<Index>(taken.size()), column) = 1.0;
      taken.push_back(column);
    } else if (rest > tolerance) {
      almost.push_back(column);
    } else {
      Eigen::VectorXd const factors = basis.sum();
      for (Index k = 0; k < factors.size(); ++k)
        if (std::abs(factors[k]) > tolerance)
          sums(k, column) = factors[k] * lengths[column] / lengths[taken[static_cast<std::size_t>(k)]];
    }
  };
  for (Index const column : order)
    if (lengths[column] <= shortest)
      result.zero.push_back(column);
    else
      keep_or_sum(column, std::max(clear, tolerance));
  for (Index const column : std::exchange(almost, {})) keep_or_sum(column, tolerance);
  // ascending, whatever the order
  result.kept = taken;
  std::sort(result.kept.begin(), result.kept.end());
  std::sort(result.zero.begin(), result.zero.end());
  result.sums.resize(static_cast<Index>(taken.size()), columns.cols());
  for (std::size_t k = 0; k < taken.size(); ++k) {
    auto const place = std::lower_bound(result.kept.begin(), result.kept.end(), taken[k]) - result.kept.begin();
    result.sums.row(place) = sums.row(static_cast<Index>(k));
  }
  return result;
}

}  // namespace torquescope
