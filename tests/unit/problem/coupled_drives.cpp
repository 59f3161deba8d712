// Rows of an arm whose last motor turns with two joints: torques from the motors' angles, without the regressor.

#include <gtest/gtest.h>

#include <algorithm>

#include "engine/fit/problem/arm_regression.hpp"
#include "engine/fit/problem/estimator.hpp"
#include "unit/problem/arm_data.hpp"

namespace torquescope {
namespace coupled_drives_test {

using namespace test;

// motor 5 turns by q5 + 0.6 q4
SerialChain coupled_chain() {
  SerialChain chain = crs_chain();
  chain.transmission = Eigen::MatrixXd::Identity(5, 5);
  chain.transmission(4, 3) = 0.6;
  return chain;
}

// frictions at the motors' speeds, felt by the transpose
std::vector<Motion> moved(SerialChain const& chain) {
  auto motion = motion_of(5, 900, 1);
  SerialChain const& links = chain;
  Eigen::VectorXd const parameters = standard_parameters(links, DriveInertias::included);
  for (Eigen::Index i = 0; i < 900; ++i) {
    Eigen::VectorXd q(5), dq(5), ddq(5);
    for (std::size_t j = 0; j < 5; ++j) {
      auto const at = static_cast<Eigen::Index>(j);
      q[at] = motion[j].q[i];
      dq[at] = motion[j].dq[i];
      ddq[at] = motion[j].ddq[i];
    }
    Eigen::VectorXd const speed = chain.transmission * dq;
    Eigen::VectorXd friction(5);
    for (Eigen::Index m = 0; m < 5; ++m) friction[m] = friction_torque(static_cast<std::size_t>(m), speed[m]);
    Eigen::VectorXd const torque =
        inverse_dynamics(links, parameters, q, dq, ddq) + chain.transmission.transpose() * friction;
    for (std::size_t j = 0; j < 5; ++j) motion[j].torque[i] = torque[static_cast<Eigen::Index>(j)];
  }
  return motion;
}

Eigen::VectorXd fitted(ArmModel const& model, std::vector<Motion> const& motion) {
  std::vector<Problem> problems;
  auto const data = stack_rows(std::vector{rows_of(model, motion)}, ArmRowChoice::moving, model,
                               Eigen::VectorXd::Ones(5), Section{"filter", {}, {}});
  return find_estimator("ols")->prepare({}, {}, problems)(data).parameters;
}

TEST(CoupledDrives, TheirFrictionAndInertiaAreFoundAtTheirMotors) {
  SerialChain const chain = coupled_chain();
  ArmModel const model(chain, {friction}, Section{"model", {}, {}});
  Eigen::VectorXd const values = fitted(model, moved(chain));
  Eigen::VectorXd const truth = model.base().from_standard(standard_parameters(chain, DriveInertias::included));
  EXPECT_LT((values.head(truth.size()) - truth).norm(), 1e-6 * truth.norm());
  auto const names = model.names();
  auto const found = [&](std::string const& name) {
    return values[std::find(names.begin(), names.end(), name) - names.begin()];
  };
  EXPECT_NEAR(found("viscous_5"), 0.7 / 5.0, 1e-6);
  EXPECT_NEAR(found("coulomb_5"), 1.1 / 5.0, 1e-6);
  EXPECT_NEAR(found("coulomb_4"), 1.1 / 4.0, 1e-6);
}

TEST(CoupledDrives, RowsOfBothJointsFeelTheMotor) {
  ArmModel const model(coupled_chain(), {friction}, Section{"model", {}, {}});
  EXPECT_EQ(model.motors_of_joint(3), (std::vector<std::size_t>{3, 4}));
  EXPECT_EQ(model.motors_of_joint(4), (std::vector<std::size_t>{4}));
  EXPECT_EQ(model.friction_alone(2), 3U);
  EXPECT_EQ(model.friction_alone(3), 0U);
  EXPECT_EQ(model.friction_alone(4), 0U);
}

}  // namespace coupled_drives_test
}  // namespace torquescope
