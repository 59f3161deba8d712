#include "engine/fit/statistics/bounded_projection.hpp"

#include <algorithm>
#include <cstddef>
#include <utility>

#include "engine/base/contract.hpp"
#include "engine/base/dense_solvers.hpp"
#include "kernels/column_products.hpp"

namespace torquescope {
namespace {

constexpr double negligible = 1e-6;  // of a column's length

// least squares of c on the chosen columns of r
BoundedGain solve_subset(Eigen::MatrixXd const& r, Eigen::VectorXd const& c, std::vector<Eigen::Index> const& chosen) {
  BoundedGain result{0.0, Eigen::VectorXd::Zero(r.cols())};
  if (chosen.empty()) return result;
  Eigen::MatrixXd const part = r(Eigen::all, chosen);
  Eigen::VectorXd const theta = solve_shortest(part, c);
  result.parameters(chosen) = theta;
  result.gain = c.squaredNorm() - (c - part * theta).squaredNorm();
  return result;
}

// columns that nuisance has been taken out of, and their lengths before
OrthonormalGroup group_of(Eigen::Ref<Eigen::MatrixXd const> const& columns,
                          Eigen::Ref<Eigen::RowVectorXd const> const& whole, std::vector<bool> non_negative) {
  OrthonormalGroup group;
  group.non_negative = std::move(non_negative);
  // modified Gram-Schmidt with pivoting by what is left of each column
  Eigen::MatrixXd left = columns;
  group.q.resize(columns.rows(), columns.cols());
  Eigen::Index rank = 0;
  for (; rank < columns.cols(); ++rank) {
    Eigen::Index best = -1;
    double share = negligible;
    for (Eigen::Index k = 0; k < left.cols(); ++k) {
      double const now = whole[k] > 0.0 ? left.col(k).norm() / whole[k] : 0.0;
      if (now > share) {
        share = now;
        best = k;
      }
    }
    if (best < 0) break;
    auto direction = group.q.col(rank);
    direction = left.col(best);
    if (rank > 0) direction -= group.q.leftCols(rank) * (group.q.leftCols(rank).transpose() * direction).eval();
    direction.normalize();
    if (rank + 1 < columns.cols()) left -= direction * (direction.transpose() * left).eval();
    left.col(best).setZero();
  }
  if (rank < columns.cols()) group.q.conservativeResize(Eigen::NoChange, rank);
  group.r = inner_products(group.q, columns);
  // what is left of a dropped column is rounding: alone it must not count as a direction
  for (Eigen::Index k = 0; k < columns.cols(); ++k)
    if (columns.col(k).norm() <= negligible * whole[k]) group.r.col(k).setZero();
  return group;
}

}  // namespace

Eigen::MatrixXd inner_products(Eigen::Ref<Eigen::MatrixXd const> const& a, Eigen::Ref<Eigen::MatrixXd const> const& b) {
  TORQUESCOPE_EXPECT(a.rows() == b.rows());
  auto const columns = [](Eigen::Ref<Eigen::MatrixXd const> const& of) {
    return kernels::Columns{of.data(), static_cast<std::size_t>(of.cols()), static_cast<std::size_t>(of.outerStride())};
  };
  Eigen::MatrixXd products(a.cols(), b.cols());
  kernels::column_products(columns(a), columns(b), static_cast<std::size_t>(a.rows()), products.data());
  return products;
}

Eigen::MatrixXd inner_products(Eigen::Ref<Eigen::MatrixXd const> const& a, Eigen::Ref<Eigen::MatrixXd const> const& b,
                               RowBlock const& rows) {
  return inner_products(a.middleRows(rows.from, rows.size()), b.middleRows(rows.from, rows.size()));
}

std::vector<OrthonormalGroup> orthonormal_groups(Eigen::MatrixXd columns, Eigen::MatrixXd const& nuisance,
                                                 std::vector<bool> const& non_negative) {
  auto const width = static_cast<Eigen::Index>(non_negative.size());
  TORQUESCOPE_EXPECT(columns.rows() == nuisance.rows() && columns.cols() % std::max<Eigen::Index>(width, 1) == 0);
  Eigen::RowVectorXd const whole = columns.colwise().norm();
  // twice is enough (Kahan): a column that is nearly nuisance loses its digits in the first pass
  for (int pass = 0; pass < 2; ++pass) columns.noalias() -= nuisance * inner_products(nuisance, columns);
  std::vector<OrthonormalGroup> groups;
  for (Eigen::Index first = 0; first < columns.cols(); first += width)
    groups.push_back(group_of(columns.middleCols(first, width), whole.segment(first, width), non_negative));
  return groups;
}

OrthonormalGroup orthonormal_group(Eigen::MatrixXd columns, Eigen::MatrixXd const& nuisance,
                                   std::vector<bool> const& non_negative) {
  TORQUESCOPE_EXPECT(non_negative.size() == static_cast<std::size_t>(columns.cols()));
  if (columns.cols() == 0) return {Eigen::MatrixXd(columns.rows(), 0), Eigen::MatrixXd(0, 0)};
  return std::move(orthonormal_groups(std::move(columns), nuisance, non_negative).front());
}

BoundedGain bounded_gain(OrthonormalGroup const& group, Eigen::VectorXd const& c) {
  TORQUESCOPE_EXPECT(c.size() == group.rank());
  std::vector<Eigen::Index> free, bounded;
  for (Eigen::Index k = 0; k < group.r.cols(); ++k)
    (group.non_negative[static_cast<std::size_t>(k)] ? bounded : free).push_back(k);
  BoundedGain best{0.0, Eigen::VectorXd::Zero(group.r.cols())};
  for (std::size_t subset = 0; subset < (std::size_t{1} << bounded.size()); ++subset) {
    std::vector<Eigen::Index> chosen = free;
    for (std::size_t k = 0; k < bounded.size(); ++k)
      if ((subset >> k & 1U) != 0) chosen.push_back(bounded[k]);
    BoundedGain const now = solve_subset(group.r, c, chosen);
    bool allowed = true;
    for (Eigen::Index k : bounded) allowed = allowed && now.parameters[k] >= 0.0;
    if (allowed && now.gain > best.gain) best = now;
  }
  return best;
}

Eigen::MatrixXd orthonormal_basis(Eigen::MatrixXd const& columns) {
  Eigen::MatrixXd const none(columns.rows(), 0);
  return orthonormal_group(columns, none, std::vector<bool>(static_cast<std::size_t>(columns.cols()), false)).q;
}

}  // namespace torquescope
