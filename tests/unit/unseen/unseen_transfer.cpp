// Whether an unseen recording agrees with the model of a training recording that misses nothing.

#include "engine/unseen/unseen_transfer.hpp"

#include <gtest/gtest.h>

#include "engine/base/random_stream.hpp"

using namespace torquescope;

namespace unseen_transfer_test {

Eigen::MatrixXd normal_matrix(Eigen::Index rows, Eigen::Index columns, std::uint32_t set) {
  RandomStream stream({11, set, RandomDomain::test}, 0, 0);
  return Eigen::MatrixXd::NullaryExpr(rows, columns, [&] { return stream.normal(); });
}

TEST(UnseenTransfer, ErrorsAreThoseOfPredictionsMadeOneByOne) {
  Eigen::MatrixXd const columns = normal_matrix(300, 4, 1), errors = 0.1 * normal_matrix(4, 7, 2);
  Eigen::VectorXd const torque = 3.0 * normal_matrix(300, 1, 3), left = normal_matrix(300, 1, 4);
  auto const found = transfer_errors(columns, torque, left, errors);
  ASSERT_EQ(found.size(), 7u);
  for (Eigen::Index k = 0; k < 7; ++k)
    EXPECT_NEAR(found[static_cast<std::size_t>(k)], (left - columns * errors.col(k)).norm() / torque.norm(), 1e-12);
}

TEST(UnseenTransfer, IsBeyondTwinsWhenItIsAQuarterWorseThanTheWorst) {
  std::vector<double> const twins{0.05, 0.06, 0.08};
  EXPECT_FALSE(beyond_twins("slow.csv", 0.0999, twins));
  auto const beyond = beyond_twins("slow.csv", 0.1001, twins);
  ASSERT_TRUE(beyond);
  EXPECT_EQ(beyond->recording, "slow.csv");
  EXPECT_EQ(beyond->most, 0.08);
  EXPECT_NEAR(beyond->usual, 0.19 / 3.0, 1e-15);
}

TEST(UnseenTransfer, SaysNothingOfAHundredthOfTheTorqueOrWithoutTwins) {
  EXPECT_FALSE(beyond_twins("clean.csv", 0.0099, {0.001, 0.002}));
  EXPECT_TRUE(beyond_twins("clean.csv", 0.0111, {0.001, 0.002}));
  EXPECT_FALSE(beyond_twins("clean.csv", 0.5, {}));
}

}  // namespace unseen_transfer_test
