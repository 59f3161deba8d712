// A fit of rows that do not tell all parameters apart: it predicts as every fit does, and is shared out evenly.

#include "engine/fit/problem/shortest_fit.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace torquescope {
namespace shortest_fit_test {

FilteredGram gram_of(std::vector<Eigen::Index> parameters, Eigen::MatrixXd const& columns,
                     Eigen::VectorXd const& torque) {
  Eigen::MatrixXd all(columns.rows(), columns.cols() + 1);
  all << columns, torque;
  return {std::move(parameters), all.transpose() * all, columns.rows()};
}

TEST(ShortestFit, IsTheFitWhereRowsTellEverything) {
  Eigen::MatrixXd const first = Eigen::MatrixXd::Random(40, 2), second = Eigen::MatrixXd::Random(40, 2);
  Eigen::Vector3d const truth(3.0, -0.2, 50.0);
  std::vector<FilteredGram> const grams{gram_of({0, 1}, first, first * truth.head(2)),
                                        gram_of({1, 2}, second, second * truth.tail(2))};
  EXPECT_LT((shortest_fit(grams, 3, Eigen::Vector2d(0.1, 2.0)) - truth).norm(), 1e-8);
}

TEST(ShortestFit, SharesOutWhatTwoColumnsHaveInCommonAndLeavesAnEmptyOneAtZero) {
  Eigen::MatrixXd columns = Eigen::MatrixXd::Zero(40, 3);
  columns.col(0).setRandom();
  columns.col(1) = columns.col(0);
  std::vector<FilteredGram> const grams{gram_of({0, 1, 2}, columns, 4.0 * columns.col(0))};
  Eigen::VectorXd const found = shortest_fit(grams, 3, Eigen::VectorXd::Constant(1, 1.0));
  EXPECT_LT((found - Eigen::Vector3d(2.0, 2.0, 0.0)).norm(), 1e-8);
}

}  // namespace shortest_fit_test
}  // namespace torquescope
