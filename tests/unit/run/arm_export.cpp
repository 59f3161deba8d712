#include "engine/run/arm_export.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

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
  auto const made = export_arm(arm, names, values, "toml");
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

TEST(ArmExport, KnowsEveryWriter) {
  std::vector<std::string> names;
  for (auto const& format : export_formats()) names.push_back(format.name);
  EXPECT_EQ(names, (std::vector<std::string>{"urdf", "toml", "json", "mjcf"}));
}

}  // namespace arm_export_test
}  // namespace torquescope
