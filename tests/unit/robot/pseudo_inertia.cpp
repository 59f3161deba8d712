#include "engine/robot/pseudo_inertia.hpp"

#include <gtest/gtest.h>

#include "unit/robot/example_arms.hpp"

namespace torquescope {
namespace pseudo_inertia_test {

LinkVector body(std::uint32_t number) { return test::random_arm(number, false).chain.links.front().vector(); }

TEST(PseudoInertia, IsAnotherFormOfTheTenNumbers) {
  LinkVector const link = body(1);
  EXPECT_LT((link_vector(pseudo_inertia(link)) - link).norm(), 1e-14 * link.norm());
  EXPECT_TRUE(is_positive_definite(pseudo_inertia(link)));
}

TEST(PseudoInertia, OfNumbersThatBreakTheTriangleInequalityIsNotPositiveDefinite) {
  Eigen::Matrix3d tensor = Eigen::Vector3d(1.0, 1.0, 2.1).asDiagonal();
  LinkVector const none = LinkInertia::from_centre(1.0, Eigen::Vector3d(0.1, 0.0, 0.0), tensor).vector();
  EXPECT_FALSE(is_positive_definite(pseudo_inertia(none)));
  tensor(2, 2) = 1.9;
  EXPECT_TRUE(is_positive_definite(
      pseudo_inertia(LinkInertia::from_centre(1.0, Eigen::Vector3d(0.1, 0.0, 0.0), tensor).vector())));
}

TEST(Divergence, IsZeroOfEqualBodiesAndTheSameInEveryFrame) {
  auto const one = LinkInertia::from_vector(body(1)), other = LinkInertia::from_vector(body(2));
  auto const between = [](LinkInertia const& a, LinkInertia const& b) {
    return divergence(pseudo_inertia(a.vector()), pseudo_inertia(b.vector()));
  };
  EXPECT_NEAR(between(one, one), 0.0, 1e-12);
  EXPECT_GT(between(one, other), 0.01);
  ChainJoint joint;
  joint.a = 0.3;
  joint.alpha = 0.7;
  joint.d = -0.4;
  auto const pose = joint_pose(joint, 1.1);
  EXPECT_NEAR(between(one.seen_from(pose), other.seen_from(pose)), between(one, other), 1e-9 * between(one, other));
}

}  // namespace pseudo_inertia_test
}  // namespace torquescope
