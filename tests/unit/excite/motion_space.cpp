#include "engine/fit/excite/motion_space.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "engine/base/error.hpp"
#include "engine/base/random_stream.hpp"
#include "unit/excite/arm_rows.hpp"

namespace torquescope {
namespace motion_space_test {

std::vector<double> random_point(Bounds const& box, std::uint32_t number) {
  RandomStream random({5, 0, RandomDomain::test}, number, 0);
  std::vector<double> point;
  for (std::size_t i = 0; i < box.dimension(); ++i) point.push_back(random.uniform(box.lower[i], box.upper[i]));
  return point;
}

// on samples 40 times as dense as those that the motion was scaled on
TEST(MotionSpace, EveryPointKeepsTheLimits) {
  auto const chain = test::limited_crs(5);
  for (double const period_s : {4.0, 10.0, 60.0}) {
    MotionSpace const space(chain, {0.9, 0.8, 0.7}, 5, period_s);
    FourierTable const dense(64 * 5 * 40, 5);
    for (std::uint32_t number = 0; number < 20; ++number) {
      auto const at = samples_of(space.motion(random_point(space.bounds(), number)), dense);
      for (Eigen::Index j = 0; j < 5; ++j) {
        auto const& joint = chain.joints[static_cast<std::size_t>(j)];
        EXPECT_LE(at.q.col(j).cwiseAbs().maxCoeff(), 0.9 * joint.upper * (1.0 + 1e-12));
        EXPECT_LE(at.dq.col(j).cwiseAbs().maxCoeff(), 0.8 * joint.max_speed);
        EXPECT_LE(at.ddq.col(j).cwiseAbs().maxCoeff(), 0.7 * joint.max_acceleration);
        EXPECT_NEAR(at.dq(0, j), 0.0, 1e-12);
        EXPECT_NEAR(at.ddq(0, j), 0.0, 1e-11);
      }
    }
  }
}

TEST(MotionSpace, LargestSizeReachesALimit) {
  auto const chain = test::limited_crs(5);
  MotionSpace const space(chain, {}, 5, 10.0);
  auto point = random_point(space.bounds(), 3);
  for (std::size_t j = 0; j < 5; ++j) point[10 * j + 9] = 1.0;
  auto const at = samples_of(space.motion(point), FourierTable(3200, 5));
  for (Eigen::Index j = 0; j < 5; ++j) {
    auto const& joint = chain.joints[static_cast<std::size_t>(j)];
    double const travel = at.q.col(j).maxCoeff() - at.q.col(j).minCoeff();
    double const most =
        std::max({travel / (joint.upper - joint.lower), at.dq.col(j).cwiseAbs().maxCoeff() / joint.max_speed,
                  at.ddq.col(j).cwiseAbs().maxCoeff() / joint.max_acceleration});
    EXPECT_GT(most, 0.995) << j;
    EXPECT_LE(most, 1.0) << j;
  }
}

TEST(MotionSpace, AJointWithoutLimitsIsTold) {
  auto chain = test::limited_crs(2);
  chain.joints[1] = ChainJoint{};
  EXPECT_THROW(MotionSpace(chain, {}, 5, 10.0), Error);
}

}  // namespace motion_space_test
}  // namespace torquescope
