// Torques of random arms against Lagrange's equations of point masses, which share no code with the engine: 4 x 4
// matrices in extended precision, derivatives by differences.

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>
#include <vector>

#include "engine/robot/inverse_dynamics.hpp"

namespace torquescope {
namespace lagrangian_test {

using Vector = Eigen::VectorXd;
using Extended = Eigen::Matrix<long double, Eigen::Dynamic, 1>;
using Matrix4 = Eigen::Matrix<long double, 4, 4>;
using Vector4 = Eigen::Matrix<long double, 4, 1>;

struct Point {
  double mass;
  Eigen::Vector3d at;
};

struct Arm {
  std::vector<ChainJoint> joints;
  std::vector<std::vector<Point>> links;
  Eigen::Vector3d gravity;
};

Matrix4 rotation(int about, long double angle) {
  Matrix4 matrix = Matrix4::Identity();
  int const a = (about + 1) % 3, b = (about + 2) % 3;
  matrix(a, a) = matrix(b, b) = std::cos(angle);
  matrix(a, b) = -std::sin(angle);
  matrix(b, a) = std::sin(angle);
  return matrix;
}

Matrix4 translation(int along, long double length) {
  Matrix4 matrix = Matrix4::Identity();
  matrix(along, 3) = length;
  return matrix;
}

// every point in the base frame, with its mass
void each_point(Arm const& arm, Extended const& q, std::function<void(double, Vector4 const&)> const& visit) {
  Matrix4 pose = Matrix4::Identity();
  for (std::size_t i = 0; i < arm.joints.size(); ++i) {
    auto const& joint = arm.joints[i];
    long double const moved = q[static_cast<Eigen::Index>(i)];
    bool const turns = joint.kind == JointKind::revolute;
    pose = pose * rotation(0, joint.alpha) * translation(0, joint.a) * rotation(2, joint.offset + (turns ? moved : 0)) *
           translation(2, joint.d + (turns ? 0 : moved));
    for (auto const& point : arm.links[i])
      visit(point.mass, pose * Vector4(point.at.x(), point.at.y(), point.at.z(), 1));
  }
}

Extended positions(Arm const& arm, Extended const& q) {
  std::vector<long double> numbers;
  each_point(arm, q, [&](double mass, Vector4 const& at) {
    for (int k = 0; k < 3; ++k) numbers.push_back(std::sqrt(static_cast<long double>(mass)) * at[k]);
  });
  return Eigen::Map<Extended>(numbers.data(), static_cast<Eigen::Index>(numbers.size()));
}

// fourth-order difference of a function of one number
Extended slope(std::function<Extended(long double)> const& f) {
  long double const h = 2e-3L;
  return (8 * (f(h) - f(-h)) - (f(2 * h) - f(-2 * h))) / (12 * h);
}

Extended curve(std::function<Extended(long double)> const& f) {
  long double const h = 2e-3L;
  return (16 * (f(h) + f(-h)) - (f(2 * h) + f(-2 * h)) - 30 * f(0)) / (12 * h * h);
}

// d/dt dL/d(dq) - dL/dq of point masses is sum of m x'' . dx/dq - m g . dx/dq, with x'' along q(t) = q + dq t + ddq
// t^2/2
Vector torque(Arm const& arm, Vector const& q, Vector const& dq, Vector const& ddq) {
  Extended const at = q.cast<long double>(), speed = dq.cast<long double>(), push = ddq.cast<long double>();
  Extended acceleration = curve([&](long double t) { return positions(arm, at + t * speed + t * t / 2 * push); });
  Eigen::Index row = 0;
  each_point(arm, at, [&](double mass, Vector4 const&) {
    for (int k = 0; k < 3; ++k) acceleration[row++] -= std::sqrt(static_cast<long double>(mass)) * arm.gravity[k];
  });
  Vector tau(q.size());
  for (Eigen::Index j = 0; j < q.size(); ++j) {
    Extended const direction = slope([&](long double step) {
      Extended moved = at;
      moved[j] += step;
      return positions(arm, moved);
    });
    tau[j] = static_cast<double>(direction.dot(acceleration));
  }
  return tau;
}

SerialChain chain_of(Arm const& arm) {
  SerialChain chain;
  chain.joints = arm.joints;
  chain.gravity = arm.gravity;
  for (auto const& points : arm.links) {
    LinkVector numbers = LinkVector::Zero();
    for (auto const& [mass, at] : points) {
      double const x = at.x(), y = at.y(), z = at.z();
      LinkVector one;
      one << 1.0, x, y, z, y * y + z * z, -x * y, -x * z, x * x + z * z, -y * z, x * x + y * y;
      numbers += mass * one;
    }
    chain.links.push_back(LinkInertia::from_vector(numbers));
  }
  return chain;
}

TEST(InverseDynamics, IsThatOfTheLagrangianOfPointMasses) {
  std::mt19937 bits(5);
  auto const uniform = [&](double low, double high) { return std::uniform_real_distribution<double>(low, high)(bits); };
  for (int trial = 0; trial < 30; ++trial) {
    Arm arm;
    Eigen::Index const n = 1 + trial % 6;
    arm.gravity = {uniform(-9.0, 9.0), uniform(-9.0, 9.0), uniform(-9.0, 9.0)};
    Vector q(n), dq(n), ddq(n);
    for (Eigen::Index i = 0; i < n; ++i) {
      ChainJoint joint;
      joint.kind = uniform(0.0, 1.0) < 0.3 ? JointKind::prismatic : JointKind::revolute;
      joint.a = uniform(-0.4, 0.4);
      joint.alpha = uniform(-2.0, 2.0);
      joint.d = uniform(-0.4, 0.4);
      joint.offset = uniform(-2.0, 2.0);
      arm.joints.push_back(joint);
      arm.links.emplace_back();
      for (int point = 0; point < 4; ++point)
        arm.links.back().push_back({uniform(0.2, 2.0), {uniform(-0.3, 0.3), uniform(-0.3, 0.3), uniform(-0.3, 0.3)}});
      q[i] = uniform(-1.0, 1.0);
      dq[i] = uniform(-1.0, 1.0);
      ddq[i] = uniform(-3.0, 3.0);
    }
    auto const chain = chain_of(arm);
    Vector const expected = torque(arm, q, dq, ddq);
    Vector const tau = inverse_dynamics(chain, standard_parameters(chain, DriveInertias::left_out), q, dq, ddq);
    EXPECT_LT((tau - expected).norm(), 1e-8 * expected.norm()) << trial;
  }
}

}  // namespace lagrangian_test
}  // namespace torquescope
