#include "engine/workflows/results/arm_export.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "engine/base/error.hpp"
#include "engine/robot/inverse_dynamics.hpp"
#include "engine/robot/robot_registry.hpp"
#include "support/temporary_folder.hpp"

namespace torquescope {
namespace arm_export_test {

// the CRS A465 of jobs/robots, identified without error; one friction beside it
TEST(ArmExport, OfATrueEstimateHasItsTorqueAndSaysWhatIsChosen) {
  auto const chain = read_robot(TORQUESCOPE_SOURCE_DIR "/jobs/robots/crs_a465.toml");
  BaseParameters const base(chain, DriveInertias::included);
  auto const chi = standard_parameters(chain, DriveInertias::included);
  IdentifiedArm arm;
  arm.chain = chain;
  arm.information = 1e6 * Eigen::MatrixXd::Identity(base.size() + 1, base.size() + 1);
  Eigen::VectorXd values(base.size() + 1);
  values << base.from_standard(chi), 0.25;
  std::vector<std::string> names;
  for (auto const& parameter : base.parameters()) names.push_back(parameter.name);
  names.emplace_back("viscous_1");
  auto const made = export_arm(arm, {names, values}, "toml");
  EXPECT_LT(made.distance, 1.0);  // the pull of the prior costs less than a standard error
  EXPECT_THAT(made.text, testing::HasSubstr("No torque depends on these, they are chosen: m1"));
  EXPECT_THAT(made.text, testing::HasSubstr("viscous_1 = 0.25"));

  test::TemporaryFolder const folder;
  auto const again = read_robot(folder.write("arm.toml", made.text));
  Eigen::Index const n = chain.size();
  Eigen::VectorXd const q = Eigen::VectorXd::LinSpaced(n, -1.0, 1.0), dq = Eigen::VectorXd::LinSpaced(n, 1.0, -0.5),
                        ddq = Eigen::VectorXd::LinSpaced(n, 2.0, 3.0);
  auto const tau = inverse_dynamics(chain, chi, q, dq, ddq);
  auto const ours = inverse_dynamics(again, standard_parameters(again, DriveInertias::included), q, dq, ddq);
  EXPECT_LT((ours - tau).norm(), 1e-3 * tau.norm());
  EXPECT_EQ(again.joints[2].upper, chain.joints[2].upper);
}

// near bodies that are a tenth too heavy, what no torque tells is a tenth too heavy; what torques tell is not
TEST(ArmExport, NearTheRobotFileKeepsWhatTheParametersLeaveOpen) {
  auto chain = read_robot(TORQUESCOPE_SOURCE_DIR "/jobs/robots/crs_a465.toml");
  BaseParameters const base(chain, DriveInertias::included);
  auto const chi = standard_parameters(chain, DriveInertias::included);
  IdentifiedArm arm;
  arm.information = 1e8 * Eigen::MatrixXd::Identity(base.size(), base.size());
  Eigen::VectorXd const values = base.from_standard(chi);
  std::vector<std::string> names;
  for (auto const& parameter : base.parameters()) names.push_back(parameter.name);
  for (auto& link : chain.links) link = LinkInertia::from_vector(1.1 * link.vector());
  arm.chain = chain;
  test::TemporaryFolder const folder;
  auto const made = [&](NearBodies near) {
    return read_robot(folder.write("arm.toml", export_arm(arm, {names, values}, "toml", near).text));
  };
  auto const near = made(NearBodies::robot_file), cubes = made(NearBodies::cubes);
  // the mass of the first link moves nothing
  EXPECT_NEAR(near.links[0].mass, chain.links[0].mass, 0.02 * chain.links[0].mass);
  EXPECT_GT(std::abs(cubes.links[0].mass - chain.links[0].mass), 0.1 * chain.links[0].mass);
  Eigen::VectorXd const again = base.from_standard(standard_parameters(near, DriveInertias::included));
  EXPECT_LT((again - values).norm(), 1e-3 * values.norm());
  arm.chain.links.clear();
  EXPECT_THROW(export_arm(arm, {names, values}, "toml", NearBodies::robot_file), Error);
}

// an estimator's own bodies are written as they are
TEST(ArmExport, WritesTheBodiesThatWereEstimated) {
  IdentifiedArm arm;
  arm.chain = read_robot(TORQUESCOPE_SOURCE_DIR "/jobs/robots/crs_a465.toml");
  BaseParameters const base(arm.chain, DriveInertias::included);
  arm.information = Eigen::MatrixXd::Identity(base.size(), base.size());
  ArmEstimate estimate;
  for (auto const& parameter : base.parameters()) estimate.names.push_back(parameter.name);
  estimate.standard = 1.2 * standard_parameters(arm.chain, DriveInertias::included);
  estimate.values = base.from_standard(estimate.standard);
  test::TemporaryFolder const folder;
  auto const made = export_arm(arm, estimate, "urdf");
  EXPECT_EQ(made.distance, 0.0);
  auto const again = read_robot(folder.write("arm.urdf", made.text));
  for (std::size_t i = 0; i < arm.chain.links.size(); ++i)
    EXPECT_NEAR(again.links[i].mass, 1.2 * arm.chain.links[i].mass, 1e-9 * again.links[i].mass);
  estimate.standard.conservativeResize(7);
  EXPECT_THROW(export_arm(arm, estimate, "urdf"), Error);
}

TEST(ArmExport, KnowsEveryWriter) {
  std::vector<std::string> names;
  for (auto const& format : export_formats()) names.push_back(format.name);
  EXPECT_EQ(names, (std::vector<std::string>{"urdf", "toml", "json", "mjcf"}));
}

}  // namespace arm_export_test
}  // namespace torquescope
