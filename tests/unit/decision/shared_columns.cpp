// What joints tell of parameters that they share: by rows made here, some of whose columns depend on each other.

#include "engine/infer/decision/shared_columns.hpp"

#include <gtest/gtest.h>

#include "engine/base/random_stream.hpp"

using namespace torquescope;

namespace shared_columns_test {

constexpr Eigen::Index samples = 400, parameters = 5;
Eigen::VectorXd const truth = (Eigen::VectorXd(parameters) << 2.0, -1.0, 0.5, 3.0, -0.7).finished();

// size: of each shared column; the noise is 0.1
SharedRows made(std::uint64_t seed, Eigen::VectorXd const& size) {
  RandomStream random({seed, 0, RandomDomain::test}, 0, 0);
  auto const drawn = [&](Eigen::Index columns) {
    Eigen::MatrixXd all(samples, columns);
    for (double& one : all.reshaped()) one = random.normal();
    return all;
  };
  SharedRows made{drawn(parameters) * size.asDiagonal(), drawn(2), {}};
  made.torque = made.shared * truth + made.own * Eigen::Vector2d(0.4, -0.3) + 0.1 * drawn(1).col(0);
  return made;
}

SharedInformation information(SharedRows const& rows) { return information_of(rows, independent_variance(rows)); }

TEST(SharedColumns, AreFittedToTheRowsOfAllJoints) {
  SharedInformation all = information(made(1, Eigen::VectorXd::Ones(parameters)));
  all.add(information(made(2, Eigen::VectorXd::Constant(parameters, 2.0))));
  EXPECT_LT((shared_parameters(all) - truth).norm(), 0.02);
}

TEST(SharedColumns, AreFreeWhereAJointTellsMoreThanAllOthers) {
  Eigen::VectorXd strong(parameters), weak(parameters);
  strong << 3.0, 3.0, 0.3, 0.0, 0.3;
  weak << 0.3, 0.3, 3.0, 3.0, 0.0;
  SharedPart const part = shared_part({information(made(1, strong)), information(made(2, weak))}, 0);
  ASSERT_EQ(part.directions.cols(), 3);  // the first two, and the last, of which the other joint knows nothing
  EXPECT_NEAR(part.known[2], truth[2], 0.05);
  EXPECT_NEAR(part.known[3], truth[3], 0.05);
  // with the free ones as its own rows have them, the joint's torque is whole
  SharedRows const own = made(1, strong);
  Eigen::MatrixXd const free = own.shared * part.directions;
  EXPECT_NEAR(independent_variance({free, own.own, own.torque - own.shared * part.known}), 0.01, 0.003);
}

TEST(SharedColumns, DependentOnesAreNoReasonToFail) {
  SharedRows one = made(1, Eigen::VectorXd::Ones(parameters)), other = made(2, Eigen::VectorXd::Ones(parameters));
  for (auto* joint : {&one, &other}) {
    joint->shared.col(1) = -2.0 * joint->shared.col(0);  // no joint tells the two apart
    joint->shared.col(4) = joint->own.col(0);            // nor this one from what is its own
  }
  one.shared.col(3) *= 1e-17;  // rounding, in place of a column that is zero
  for (auto* joint : {&one, &other}) joint->torque = joint->shared * truth + joint->own * Eigen::Vector2d(0.4, -0.3);
  SharedInformation all = information(one);
  all.add(information(other));
  Eigen::VectorXd const found = shared_parameters(all);
  EXPECT_NEAR(found[0] - 2.0 * found[1], truth[0] - 2.0 * truth[1], 1e-6);
  EXPECT_NEAR(found[2], truth[2], 1e-6);
  EXPECT_EQ(found[4], 0.0);
  SharedPart const part = shared_part({information(one), information(other)}, 0);
  EXPECT_LE(part.directions.cols(), 2);
  EXPECT_LT(part.known.norm() + part.directions.norm(), 1e6);
}

}  // namespace shared_columns_test
