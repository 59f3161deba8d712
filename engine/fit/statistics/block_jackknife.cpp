#include "engine/fit/statistics/block_jackknife.hpp"

#include <cmath>
#include <limits>
#include <vector>

#include "engine/base/contract.hpp"
#include "engine/fit/statistics/equal_blocks.hpp"
#include "engine/fit/statistics/scaled_solution.hpp"

namespace torquescope {
namespace {

constexpr Eigen::Index n_blocks = 10;

Eigen::VectorXd fit_without(RowBlock const& block, Eigen::VectorXd const& signal, Eigen::MatrixXd const& columns,
                            CoefficientBounds const& bounds) {
  Eigen::Index const after = signal.size() - block.to;
  Eigen::MatrixXd rest(block.from + after, columns.cols());
  rest << columns.topRows(block.from), columns.bottomRows(after);
  Eigen::VectorXd left(block.from + after);
  left << signal.head(block.from), signal.tail(after);
  return solve_scaled(rest, left, bounds);
}

double spread(std::vector<double> const& values) {
  if (values.size() < static_cast<std::size_t>(n_blocks) / 2) return 0.0;
  auto const n = static_cast<double>(values.size());
  double mean = 0.0, squares = 0.0;
  for (double value : values) mean += value / n;
  for (double value : values) squares += (value - mean) * (value - mean);
  return std::sqrt((n - 1.0) / n * squares);
}

}  // namespace

Eigen::VectorXd jackknife_deviations(Eigen::VectorXd const& signal, Eigen::MatrixXd const& columns) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  return jackknife_deviations(
      signal, columns,
      {Eigen::VectorXd::Constant(columns.cols(), -infinity), Eigen::VectorXd::Constant(columns.cols(), infinity)});
}

Eigen::VectorXd jackknife_deviations(Eigen::VectorXd const& signal, Eigen::MatrixXd const& columns,
                                     CoefficientBounds const& bounds) {
  TORQUESCOPE_EXPECT(signal.size() >= n_blocks);
  return jackknife_deviations(signal, columns, bounds, equal_blocks(signal.size(), n_blocks));
}

Eigen::VectorXd jackknife_deviations(Eigen::VectorXd const& signal, Eigen::MatrixXd const& columns,
                                     CoefficientBounds const& bounds, std::vector<RowBlock> const& blocks) {
  TORQUESCOPE_EXPECT(columns.rows() == signal.size());
  Eigen::RowVectorXd const energy = columns.colwise().squaredNorm();
  std::vector<std::vector<double>> found(static_cast<std::size_t>(columns.cols()));
  for (auto const& block : blocks) {
    Eigen::VectorXd const fit = fit_without(block, signal, columns, bounds);
    Eigen::RowVectorXd const inside = columns.middleRows(block.from, block.size()).colwise().squaredNorm();
    for (Eigen::Index k = 0; k < columns.cols(); ++k)
      if (inside[k] <= 0.5 * energy[k]) found[static_cast<std::size_t>(k)].push_back(fit[k]);
  }
  Eigen::VectorXd result(columns.cols());
  for (Eigen::Index k = 0; k < result.size(); ++k) result[k] = spread(found[static_cast<std::size_t>(k)]);
  return result;
}

}  // namespace torquescope
