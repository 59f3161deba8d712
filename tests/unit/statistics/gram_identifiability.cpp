#include "engine/fit/statistics/gram_identifiability.hpp"

#include <gtest/gtest.h>

#include <random>

namespace torquescope {
namespace gram_identifiability_test {

Eigen::MatrixXd columns(Eigen::Index n) {
  std::mt19937 bits(3);
  std::normal_distribution<double> normal;
  return Eigen::MatrixXd::NullaryExpr(200, n, [&](Eigen::Index, Eigen::Index) { return normal(bits); });
}

TEST(GramIdentifiability, TellsAloneFromGroupsFromNothing) {
  auto phi = columns(7);
  phi.col(3) = 2.0 * phi.col(1) + 1e-4 * phi.col(3);  // a pair
  phi.col(6) = phi.col(4) - phi.col(5);               // three that are dependent
  phi.col(2).setZero();
  phi.col(0) *= 1e6;  // units do not matter
  auto const found = gram_identifiability(phi.transpose() * phi);
  using enum Seen;
  EXPECT_EQ(found.seen,
            (std::vector<Seen>{alone, in_a_group, not_at_all, in_a_group, in_a_group, in_a_group, in_a_group}));
  EXPECT_EQ(found.groups, (std::vector<std::vector<Eigen::Index>>{{1, 3}, {4, 5, 6}}));
  EXPECT_TRUE(std::isinf(found.condition));
}

TEST(GramIdentifiability, OfIndependentColumnsIsAloneForAll) {
  auto const phi = columns(5);
  auto const found = gram_identifiability(phi.transpose() * phi);
  EXPECT_EQ(found.seen, std::vector<Seen>(5, Seen::alone));
  EXPECT_TRUE(found.groups.empty());
  EXPECT_LT(found.condition, 2.0);
}

// the limit of Belsley, Kuh, Welsch: a pair of unit columns at angle a has the condition cot(a / 2)
TEST(GramIdentifiability, JoinsAPairAboveConditionThirty) {
  auto const pair = [](double angle) {
    Eigen::MatrixXd gram(2, 2);
    gram << 1.0, std::cos(angle), std::cos(angle), 1.0;
    return gram_identifiability(gram);
  };
  EXPECT_EQ(pair(2.0 / 29.0).seen[0], Seen::alone);
  EXPECT_NEAR(pair(2.0 / 29.0).condition, 29.0, 0.1);
  EXPECT_EQ(pair(2.0 / 31.0).seen[0], Seen::in_a_group);
}

TEST(GramIdentifiability, DoesNotSeeWhatStaysWithinNoise) {
  auto phi = columns(3);
  phi.col(1) *= 1e-3;  // rows in units of their noise: |column| about 0.014
  Eigen::Vector3d const plausible(1.0, 10.0, 1.0);
  EXPECT_EQ(gram_identifiability(phi.transpose() * phi, plausible).seen[1], Seen::not_at_all);
  EXPECT_EQ(gram_identifiability(phi.transpose() * phi, 100.0 * plausible).seen[1], Seen::alone);
}

}  // namespace gram_identifiability_test
}  // namespace torquescope
