#include "engine/fit/optim/success_history.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

namespace torquescope {
namespace success_history_test {

RandomKey const key{7, 0, RandomDomain::test};
constexpr double rounding = 1e-15;

// by hand: weights 1/4, 3/4; F: (0.0625 + 0.75) / (0.125 + 0.75); CR: (0.01 + 0.27) / (0.05 + 0.45)
TEST(SuccessHistory, RemembersLehmerMeansWeightedByImprovement) {
  SuccessHistory history(2);
  history.learn(std::vector<Success>{{{0.5, 0.2}, 1.0}, {{1.0, 0.6}, 3.0}});
  EXPECT_NEAR(history.F()[0], 0.8125 / 0.875, rounding);
  EXPECT_NEAR(history.CR()[0], 0.56, rounding);
  EXPECT_EQ(history.F()[1], 0.5);
  EXPECT_EQ(history.CR()[1], 0.5);
}

TEST(SuccessHistory, ReplacesItsEntriesInTurn) {
  SuccessHistory history(2);
  for (double const F : {0.2, 0.4, 0.8}) history.learn(std::vector<Success>{{{F, F}, 1.0}});
  EXPECT_NEAR(history.F()[0], 0.8, rounding);
  EXPECT_NEAR(history.F()[1], 0.4, rounding);
  history.learn({});
  history.learn(std::vector<Success>{{{0.1, 0.1}, 1.0}});
  EXPECT_NEAR(history.F()[0], 0.8, rounding) << "a generation without success takes no entry";
  EXPECT_NEAR(history.F()[1], 0.1, rounding);
}

TEST(SuccessHistory, ATerminalCrossoverRateStaysZero) {
  SuccessHistory history(1);
  history.learn(std::vector<Success>{{{0.5, 0.0}, 1.0}, {{0.7, 0.0}, 2.0}});
  EXPECT_EQ(history.CR()[0], SuccessHistory::terminal);
  for (std::uint32_t member = 0; member < 100; ++member) {
    RandomStream random(key, 1, member);
    EXPECT_EQ(history.draw(random).CR, 0.0);
  }
  history.learn(std::vector<Success>{{{0.5, 0.9}, 1.0}});
  EXPECT_EQ(history.CR()[0], SuccessHistory::terminal);
}

TEST(SuccessHistory, DrawsRoundItsEntriesWithinTheirRanges) {
  SuccessHistory history(1);
  history.learn(std::vector<Success>{{{0.6, 0.95}, 1.0}});
  std::vector<double> F, CR;
  for (std::uint32_t member = 0; member < 20001; ++member) {
    RandomStream random(key, 2, member);
    auto const controls = history.draw(random);
    ASSERT_TRUE(controls.F > 0.0 && controls.F <= 1.0 && controls.CR >= 0.0 && controls.CR <= 1.0);
    F.push_back(controls.F);
    CR.push_back(controls.CR);
  }
  std::sort(F.begin(), F.end());
  std::sort(CR.begin(), CR.end());
  // Cauchy: quartiles one width from the centre, both moved up a little by the draws at or below 0, which are drawn
  // again: P(F <= 0) = 1/2 - atan(6)/pi = 0.0526; five standard errors of a quantile at this density are 0.02
  EXPECT_NEAR(F[5000], 0.514, 0.02);
  EXPECT_NEAR(F[10000], 0.608, 0.02);
  // Normal(0.95, 0.1), and 31 % of it at 1
  EXPECT_NEAR(CR[10000], 0.95, 0.01);
  EXPECT_NEAR(static_cast<double>(std::count(CR.begin(), CR.end(), 1.0)) / 20001.0, 0.3085, 0.02);
}

TEST(SuccessHistory, GoesOnFromItsNumbers) {
  SuccessHistory history(3);
  history.learn(std::vector<Success>{{{0.3, 0.4}, 1.0}});
  SuccessHistory copy(3);
  copy.restore(history.numbers());
  for (auto* one : {&history, &copy}) one->learn(std::vector<Success>{{{0.9, 0.1}, 1.0}});
  EXPECT_EQ(copy.numbers(), history.numbers());
}

}  // namespace success_history_test
}  // namespace torquescope
