#include "unit/robot/example_arms.hpp"

#include <numbers>
#include <vector>

#include "engine/base/random_stream.hpp"
#include "engine/robot/standard_dh.hpp"

namespace torquescope::test {

namespace {

constexpr double right = std::numbers::pi / 2.0;

struct Row {
  double a, alpha, d, offset;
};

SerialChain chain_of(std::vector<Row> const& rows) {
  SerialChain chain;
  for (auto const& row : rows) {
    ChainJoint joint;
    joint.a = row.a;
    joint.alpha = row.alpha;
    joint.d = row.d;
    joint.offset = row.offset;
    chain.joints.push_back(joint);
  }
  return chain;
}

// a body of positive density: ten point masses around a centre
LinkInertia random_link(RandomStream& random) {
  LinkInertia link;
  Eigen::Vector3d const centre(random.uniform(-0.3, 0.3), random.uniform(-0.3, 0.3), random.uniform(-0.3, 0.3));
  for (int point = 0; point < 10; ++point) {
    Eigen::Vector3d const at =
        centre + Eigen::Vector3d(random.uniform(-0.2, 0.2), random.uniform(-0.2, 0.2), random.uniform(-0.2, 0.2));
    link = link + LinkInertia::from_centre(random.uniform(0.1, 0.8), at, Eigen::Matrix3d::Zero());
  }
  return link;
}

}  // namespace

SerialChain crs_a465(std::size_t n_joints) {
  auto chain = chain_of({{0.0, right, 0.3302, 0.0},
                         {0.3048, 0.0, 0.0, right},
                         {0.0, -right, 0.0, -right},
                         {0.0, right, 0.3302, 0.0},
                         {0.0, -right, 0.0, 0.0},
                         {0.0, 0.0, 0.0762, 0.0}});
  chain.joints.resize(n_joints);
  return from_standard_dh(chain);
}

SerialChain ur10e() {
  return from_standard_dh(chain_of({{0.0, right, 0.1807, 0.0},
                                    {-0.6127, 0.0, 0.0, 0.0},
                                    {-0.57155, 0.0, 0.0, 0.0},
                                    {0.0, right, 0.17415, 0.0},
                                    {0.0, -right, 0.11985, 0.0},
                                    {0.0, 0.0, 0.11655, 0.0}}));
}

SerialChain panda() {
  return chain_of({{0.0, 0.0, 0.333, 0.0},
                   {0.0, -right, 0.0, 0.0},
                   {0.0, right, 0.316, 0.0},
                   {0.0825, right, 0.0, 0.0},
                   {-0.0825, -right, 0.384, 0.0},
                   {0.0, right, 0.0, 0.0},
                   {0.088, right, 0.0, 0.0}});
}

SerialChain puma_560() {
  return chain_of({{0.0, 0.0, 0.0, 0.0},
                   {0.0, -right, 0.2435, 0.0},
                   {0.4318, 0.0, -0.0934, 0.0},
                   {-0.0203, right, 0.4331, 0.0},
                   {0.0, -right, 0.0, 0.0},
                   {0.0, right, 0.0, 0.0}});
}

RandomArm random_arm(std::uint32_t number, bool special, bool only_revolute) {
  RandomStream random({20, 0, RandomDomain::test}, number, special ? 1 : 0);
  RandomArm arm;
  auto& chain = arm.chain;
  Eigen::Index const n = 1 + random.below(7);
  for (Eigen::Index i = 0; i < n; ++i) {
    ChainJoint joint;
    if (!only_revolute && random.below(4) == 0) joint.kind = JointKind::prismatic;
    joint.a = special && random.below(2) == 0 ? 0.0 : random.uniform(-0.5, 0.5);
    joint.d = special && random.below(2) == 0 ? 0.0 : random.uniform(-0.5, 0.5);
    joint.alpha = special ? right * (static_cast<double>(random.below(4)) - 1.0) : random.uniform(-3.0, 3.0);
    joint.offset = special ? right * (static_cast<double>(random.below(4)) - 1.0) : random.uniform(-3.0, 3.0);
    joint.drive_inertia = random.uniform(0.1, 1.0);
    chain.joints.push_back(joint);
    chain.links.push_back(random_link(random));
  }
  if (special && random.below(3) == 0) chain.gravity = {9.81, 0.0, 0.0};
  if (!special) chain.gravity = {random.uniform(-9.0, 9.0), random.uniform(-9.0, 9.0), random.uniform(-9.0, 9.0)};
  arm.q = arm.dq = arm.ddq = Eigen::VectorXd(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    arm.q[i] = random.uniform(-3.0, 3.0);
    arm.dq[i] = random.uniform(-2.0, 2.0);
    arm.ddq[i] = random.uniform(-5.0, 5.0);
  }
  return arm;
}

}  // namespace torquescope::test
