#include "engine/fit/excite/arm_clearance.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "engine/base/random_stream.hpp"

namespace torquescope {
namespace arm_clearance_test {

using Eigen::Vector3d;

Vector3d random_point(RandomStream& random) {
  return {random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0)};
}

TEST(Distance, OfLinesIsTheLeastOfTheirPoints) {
  for (std::uint32_t number = 0; number < 100; ++number) {
    RandomStream random({6, 0, RandomDomain::test}, number, 0);
    LineSegment const a{random_point(random), random_point(random)}, b{random_point(random), random_point(random)};
    double least = 10.0;
    int const n = 100;
    for (int i = 0; i <= n; ++i)
      for (int k = 0; k <= n; ++k)
        least = std::min(least, (a.from + (a.to - a.from) * i / n - b.from - (b.to - b.from) * k / n).norm());
    double const found = distance(a, b);
    EXPECT_LE(found, least + 1e-12);
    EXPECT_GT(found, least - 0.03) << number;
  }
}

TEST(Distance, OfParallelAndPointLikeLines) {
  LineSegment const a{{0, 0, 0}, {1, 0, 0}};
  EXPECT_NEAR(distance(a, {{0.5, 1, 0}, {3, 1, 0}}), 1.0, 1e-15);
  EXPECT_NEAR(distance(a, {{2, 0, 0}, {3, 0, 0}}), 1.0, 1e-15);
  EXPECT_NEAR(distance(a, {{2, 0, 2}, {2, 0, 2}}), std::sqrt(5.0), 1e-15);
}

// three links of 1 m in a vertical plane; all angles 0: stretched out along x, at a height of 1 m
SerialChain planar_arm() {
  SerialChain chain;
  double const right = std::acos(0.0);
  chain.joints.resize(3);
  chain.joints[0].d = 1.0;
  chain.joints[0].alpha = 0.0;
  chain.joints[1].alpha = right;
  chain.joints[2].a = 1.0;
  chain.flange.position = {1.0, 0.0, 0.0};
  return chain;
}

TEST(ArmClearance, TableIsMeasuredFromTheLowestPoint) {
  auto const chain = planar_arm();
  Eigen::Vector3d const down{0.0, -0.5, 0.0};
  double const lowest = 1.0 - 2.0 * std::sin(0.5);
  EXPECT_NEAR(clearance_lack(chain, {.floor_m = lowest + 0.2}, down), 0.2, 1e-12);
  EXPECT_EQ(clearance_lack(chain, {.floor_m = lowest - 1e-9}, down), 0.0);
}

// folded back, the last link comes near to the column
TEST(ArmClearance, LinksKeepApart) {
  auto const chain = planar_arm();
  Eigen::Vector3d const folded{0.0, 0.5, 3.0};
  double const lack = clearance_lack(chain, {.clearance_m = 0.2}, folded);
  EXPECT_GT(lack, 0.0);
  EXPECT_LE(lack, 0.2);
  EXPECT_EQ(clearance_lack(chain, {.clearance_m = 0.2}, Eigen::Vector3d{0.0, 0.5, 0.3}), 0.0);
}

}  // namespace arm_clearance_test
}  // namespace torquescope
