// Torques of random arms against Orocos KDL.

#include <gtest/gtest.h>

#if defined(TORQUESCOPE_KDL)

#include <kdl/chainidsolver_recursive_newton_euler.hpp>

#include "engine/robot/inverse_dynamics.hpp"
#include "unit/robot/example_arms.hpp"

namespace torquescope {
namespace kdl_test {

KDL::Frame frame_of(FramePose const& pose) {
  auto const& r = pose.rotation;
  return {KDL::Rotation(r(0, 0), r(0, 1), r(0, 2), r(1, 0), r(1, 1), r(1, 2), r(2, 0), r(2, 1), r(2, 2)),
          KDL::Vector(pose.position.x(), pose.position.y(), pose.position.z())};
}

KDL::RigidBodyInertia inertia_of(LinkInertia const& link) {
  Eigen::Vector3d const centre = link.first_moment / link.mass;
  Eigen::Matrix3d const about = link.about_centre();
  return KDL::RigidBodyInertia(
      link.mass, KDL::Vector(centre.x(), centre.y(), centre.z()),
      KDL::RotationalInertia(about(0, 0), about(1, 1), about(2, 2), about(0, 1), about(0, 2), about(1, 2)));
}

// a fixed segment to each axis, then one that only turns or slides
KDL::Chain chain_of(SerialChain const& chain) {
  KDL::Chain made;
  for (std::size_t i = 0; i < chain.joints.size(); ++i) {
    auto const& joint = chain.joints[i];
    bool const turns = joint.kind == JointKind::revolute;
    made.addSegment(KDL::Segment(KDL::Joint(KDL::Joint::Fixed), frame_of(joint_pose(joint, 0.0))));
    made.addSegment(
        KDL::Segment(KDL::Joint(turns ? KDL::Joint::RotZ : KDL::Joint::TransZ, 1.0, 0.0, joint.drive_inertia),
                     KDL::Frame::Identity(), inertia_of(chain.links[i])));
  }
  return made;
}

KDL::JntArray array_of(Eigen::VectorXd const& numbers) {
  KDL::JntArray array(static_cast<unsigned>(numbers.size()));
  array.data = numbers;
  return array;
}

TEST(InverseDynamics, IsThatOfKdl) {
  for (std::uint32_t number = 0; number < 100; ++number) {
    auto const arm = test::random_arm(number, number % 2 == 0);
    auto const& g = arm.chain.gravity;
    auto const chain = chain_of(arm.chain);
    KDL::ChainIdSolver_RNE solver(chain, KDL::Vector(g.x(), g.y(), g.z()));
    KDL::JntArray tau(static_cast<unsigned>(arm.q.size()));
    KDL::Wrenches const none(chain.getNrOfSegments(), KDL::Wrench::Zero());
    ASSERT_EQ(solver.CartToJnt(array_of(arm.q), array_of(arm.dq), array_of(arm.ddq), none, tau), 0);
    auto const chi = standard_parameters(arm.chain, DriveInertias::included);
    auto const ours = inverse_dynamics(arm.chain, chi, arm.q, arm.dq, arm.ddq);
    EXPECT_LT((ours - tau.data).norm(), 1e-12 * tau.data.norm()) << number;
  }
}

}  // namespace kdl_test
}  // namespace torquescope

#else

TEST(InverseDynamics, IsThatOfKdl) { GTEST_SKIP() << "Orocos KDL is not installed (liborocos-kdl-dev)"; }

#endif
