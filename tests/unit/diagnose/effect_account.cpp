// The shortest interval that holds a share of the weight is found among all pairs of points.

#include "engine/diagnose/effect_account.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "engine/base/random_stream.hpp"

namespace torquescope {
namespace {

// a sum in another order may miss a share that is met exactly
constexpr double rounding = 1e-12;

double held(Eigen::VectorXd const& at, Eigen::VectorXd const& weight, double from, double to) {
  return ((at.array() >= from) && (at.array() <= to)).select(weight, 0.0).sum();
}

double shortest_width(Eigen::VectorXd const& at, Eigen::VectorXd const& weight, double share) {
  double best = std::numeric_limits<double>::infinity();
  for (double from : at)
    for (double to : at)
      if (to >= from && to - from < best && held(at, weight, from, to) >= share * weight.sum()) best = to - from;
  return best;
}

TEST(ShortestInterval, IsTheShortestOfAllPairsOfPoints) {
  for (std::uint32_t set = 0; set < 300; ++set) {
    RandomStream stream({51, set, RandomDomain::test}, 0, 0);
    Eigen::Index const n = 1 + static_cast<Eigen::Index>(stream.below(40));
    Eigen::VectorXd at(n), weight(n);
    bool const has_ties = set % 3 == 0;
    for (double& value : at) value = has_ties ? static_cast<double>(stream.below(8)) : stream.normal();
    for (double& value : weight) value = stream.uniform() < 0.2 ? 0.0 : std::pow(stream.normal(), 4);
    weight[0] += 1e-3;  // some weight somewhere
    double const share = stream.uniform(0.1, 0.95);
    auto const [from, to] = shortest_interval(at, weight, share);
    EXPECT_GE(held(at, weight, from, to), share * weight.sum() * (1.0 - rounding)) << set;
    EXPECT_NEAR(to - from, shortest_width(at, weight, share), rounding) << set;
  }
}

TEST(ShortestInterval, IsAPointWhenOnePointHoldsEnough) {
  Eigen::VectorXd const at = Eigen::Vector4d(3.0, -1.0, 0.5, 2.0), weight = Eigen::Vector4d(0.0, 0.1, 5.0, 0.1);
  EXPECT_EQ(shortest_interval(at, weight, 0.8), std::make_pair(0.5, 0.5));
}

TEST(ShortestInterval, DoesNotDependOnTheOrderOfTheRows) {
  RandomStream stream({52, 0, RandomDomain::test}, 0, 0);
  Eigen::VectorXd at(200), weight(200);
  for (double& value : at) value = stream.normal();
  for (double& value : weight) value = stream.uniform();
  EXPECT_EQ(shortest_interval(at, weight, 0.8), shortest_interval(at.reverse(), weight.reverse(), 0.8));
}

TEST(ShortestInterval, OfEvenWeightIsItsShareOfTheAxis) {
  Eigen::VectorXd const at = Eigen::VectorXd::LinSpaced(1001, 0.0, 10.0);
  auto const [from, to] = shortest_interval(at, Eigen::VectorXd::Ones(1001), 0.8);
  EXPECT_NEAR(to - from, 8.0, 0.02);
}

}  // namespace
}  // namespace torquescope
