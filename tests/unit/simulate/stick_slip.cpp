#include "engine/simulate/stick_slip.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "engine/base/random_stream.hpp"
#include "support/decompositions.hpp"

namespace torquescope {
namespace stick_slip_test {

using Eigen::Index;

struct Example {
  Eigen::MatrixXd mass;
  Eigen::VectorXd push;
  std::vector<DryBranches> dry;
};

Example random_example(std::uint32_t number) {
  RandomStream random({7, 0, RandomDomain::test}, number, 0);
  auto const n = static_cast<Index>(1 + random.below(5));
  Eigen::MatrixXd root(n, n);
  for (double& entry : root.reshaped()) entry = random.normal();
  Example example{root * root.transpose() + 0.1 * Eigen::MatrixXd::Identity(n, n), Eigen::VectorXd(n), {}};
  for (double& entry : example.push) entry = 2.0 * random.normal();
  for (Index j = 0; j < n; ++j) example.dry.push_back({-random.uniform(0.0, 3.0), random.uniform(0.0, 3.0)});
  return example;
}

// of one set of contacts; whether friction and accelerations agree with it
bool is_solution(Example const& example, std::vector<int> const& contacts, Eigen::VectorXd& acceleration) {
  Index const n = example.push.size();
  Eigen::MatrixXd equations = Eigen::MatrixXd::Zero(n, n);
  Eigen::VectorXd right = Eigen::VectorXd::Zero(n);
  for (Index j = 0; j < n; ++j) {
    auto const at = static_cast<std::size_t>(j);
    if (contacts[at] == 0) {
      equations(j, j) = 1.0;
    } else {
      equations.row(j) = example.mass.row(j);
      right[j] = example.push[j] - (contacts[at] > 0 ? example.dry[at].forward : example.dry[at].backward);
    }
  }
  acceleration = test::least_squares(equations, right);
  Eigen::VectorXd const friction = example.push - example.mass * acceleration;
  for (Index j = 0; j < n; ++j) {
    auto const at = static_cast<std::size_t>(j);
    if (contacts[at] == 0 ? friction[j] > example.dry[at].forward || friction[j] < example.dry[at].backward
                          : contacts[at] * acceleration[j] < 0.0)
      return false;
  }
  return true;
}

Eigen::VectorXd by_trying_all(Example const& example) {
  auto const n = static_cast<std::size_t>(example.push.size());
  std::vector<int> contacts(n, -1);
  Eigen::VectorXd acceleration;
  for (;;) {
    if (is_solution(example, contacts, acceleration)) return acceleration;
    std::size_t j = 0;
    while (j < n && contacts[j] == 1) contacts[j++] = -1;
    if (j == n) return Eigen::VectorXd::Constant(example.push.size(), NAN);
    ++contacts[j];
  }
}

TEST(StickSlip, FindsTheOneSetOfContacts) {
  int held = 0, slipping = 0;
  for (std::uint32_t number = 0; number < 400; ++number) {
    auto const example = random_example(number);
    StickSlip solver(example.push.size());
    std::vector<JointContact> contacts(example.dry.size(), {Contact::held, true});
    solver.solve(example.mass, example.push, example.dry, contacts);
    Eigen::VectorXd const expected = by_trying_all(example);
    EXPECT_LT((solver.acceleration() - expected).norm(), 1e-10 * (1.0 + expected.norm())) << number;
    for (auto const& joint : contacts) ++(joint.contact == Contact::held ? held : slipping);
  }
  EXPECT_GT(held, 200);
  EXPECT_GT(slipping, 200);
}

// a moving joint keeps its branch, whatever its acceleration
TEST(StickSlip, LeavesGivenContactsAlone) {
  auto const example = random_example(3);
  StickSlip solver(example.push.size());
  std::vector<JointContact> contacts(example.dry.size(), {Contact::backward, false});
  solver.solve(example.mass, example.push, example.dry, contacts);
  Eigen::VectorXd right = example.push;
  for (Index j = 0; j < right.size(); ++j) right[j] -= example.dry[static_cast<std::size_t>(j)].backward;
  EXPECT_LT((example.mass * solver.acceleration() - right).norm(), 1e-12 * right.norm());
  for (auto const& joint : contacts) EXPECT_EQ(joint.contact, Contact::backward);
}

}  // namespace stick_slip_test
}  // namespace torquescope
