#include "engine/fit/problem/regressor_health.hpp"

#include <gmock/gmock.h>

#include "unit/problem/joint_data.hpp"

namespace torquescope {
namespace regressor_health_test {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

RegressionData data_of(std::vector<std::string> const& terms, Motion const& motion) {
  Regressor const regressor(terms, JointKind::revolute);
  return test::regression_data(motion, regressor, Eigen::VectorXd::Ones(motion.q.size()));
}

TEST(RegressorHealth, SaysNothingAboutAGoodRecording) {
  auto const health = regressor_health(test::seed_data(20.0));
  EXPECT_TRUE(health.identifiable);
  EXPECT_EQ(health.words, "");
  EXPECT_LT(health.condition_number, 10.0);
}

TEST(RegressorHealth, ConditionIsOneForOrthogonalColumns) {
  auto data = test::seed_data(1.0);
  data.phi = Eigen::MatrixXd::Identity(100, 4) * 3.0;
  auto const health = regressor_health(data);
  EXPECT_NEAR(health.condition_number, 1.0, 1e-14);
  EXPECT_LT((health.correlation - Eigen::Matrix4d::Identity()).norm(), 1e-14);
}

TEST(RegressorHealth, ScaledConditionDoesNotDependOnUnitsTheRawOneDoes) {
  auto data = test::seed_data(10.0);
  auto const before = regressor_health(data);
  data.phi.col(0) *= 1e4;
  auto const after = regressor_health(data);
  EXPECT_NEAR(after.condition_number, before.condition_number, 1e-9 * before.condition_number);
  EXPECT_GT(after.condition_number_raw, 100.0 * before.condition_number_raw);
}

TEST(RegressorHealth, CorrelationIsTheCosineBetweenColumns) {
  auto const data = test::seed_data(10.0);
  auto const health = regressor_health(data);
  double const cosine = data.phi.col(1).dot(data.phi.col(2)) / data.phi.col(1).norm() / data.phi.col(2).norm();
  EXPECT_NEAR(health.correlation(1, 2), cosine, 1e-14);
  EXPECT_LT((health.correlation.diagonal() - Eigen::Vector4d::Ones()).norm(), 1e-14);
}

TEST(RegressorHealth, AsksForWiderSpeedsWhenViscousLooksLikeOffset) {
  // both directions, but almost always forwards at nearly one speed
  auto motion = test::multisine(10.0);
  motion.dq = (1.0 + 0.03 * motion.dq.array()).matrix();
  motion.dq[7] = -0.1;
  auto const health = regressor_health(data_of({"inertia", "viscous", "offset"}, motion));
  EXPECT_TRUE(health.identifiable);
  EXPECT_THAT(health.words,
              AllOf(HasSubstr("viscous and offset correlate 0.9"),
                    HasSubstr(": trust what both make together, neither value by itself; wider speeds would help")));
}

TEST(RegressorHealth, OnlyRemarksOnAPairThatIsToldApartAtACost) {
  // gravity and an offset on a travel well below a turn: as nearly every recording of a joint with gravity has it
  auto const health = regressor_health(data_of({"inertia", "viscous", "offset", "gravity"}, test::multisine(10.0)));
  EXPECT_EQ(health.words, "");
  EXPECT_THAT(health.remark, AllOf(HasSubstr("offset and gravity_cos correlate 0.9"), Not(HasSubstr("trust"))));
  EXPECT_EQ(regressor_health(test::seed_data(20.0)).remark, "");
}

TEST(RegressorHealth, AsksForBothDirectionsWhenThereIsOne) {
  auto motion = test::multisine(10.0);
  motion.dq = (2.0 + 0.1 * motion.dq.array()).matrix();
  auto const health = regressor_health(data_of({"viscous", "coulomb"}, motion));
  EXPECT_THAT(health.words, HasSubstr("motion in both directions would help"));
}

TEST(RegressorHealth, NamesAGroupThatNoPairGivesAway) {
  // offset = sum of many parts: each pair is loosely correlated, all together are dependent
  auto data = test::seed_data(10.0);
  Eigen::VectorXd const noise = test::white_noise(data.rows(), 4, 1e-3);
  data.phi.col(0).setRandom();
  for (Eigen::Index r = 0; r < 4; ++r) data.phi.col(r) = test::white_noise(data.rows(), 20 + std::uint32_t(r), 1.0);
  data.phi.col(3) = data.phi.col(0) + data.phi.col(1) + data.phi.col(2) + noise;
  auto const health = regressor_health(data);
  EXPECT_GT(health.condition_number, 30.0);
  EXPECT_THAT(health.words, HasSubstr("inertia, viscous, coulomb_positive and coulomb_negative are nearly dependent"));
  EXPECT_THAT(health.words, AllOf(HasSubstr("no value by itself"), HasSubstr("stronger accelerations")));
}

TEST(NotIdentifiable, NamesProportionalColumnsAndTheMotionThatSeparatesThem) {
  // a free pendulum at small angles: acceleration proportional to position
  auto motion = test::multisine(10.0);
  motion.q = 1e-9 * motion.q;
  motion.ddq = -4.0 * motion.q;
  auto const data = data_of({"inertia", "gravity", "viscous"}, motion);
  auto const health = regressor_health(data);
  EXPECT_FALSE(health.identifiable);
  try {
    test::fit("ols", data);
    FAIL() << "fitted two proportional columns";
  } catch (Error const& error) {
    EXPECT_EQ(error.code(), ExitCode::bad_data);
    EXPECT_THAT(error.problems()[0].what, HasSubstr("inertia and gravity_sin"));
    EXPECT_THAT(error.problems()[0].help, AllOf(HasSubstr("stronger accelerations"), HasSubstr("range of positions")));
  }
}

TEST(NotIdentifiable, WantsMoreSamplesThanParameters) {
  auto const data = data_of(test::seed_terms, test::multisine(0.04));
  EXPECT_FALSE(regressor_health(data).identifiable);
  EXPECT_THAT(regressor_health(data).words, HasSubstr("4 samples are too few for 4 parameters"));
  try {
    test::fit("ols", data);
    FAIL() << "fitted 4 parameters to 4 samples";
  } catch (Error const& error) {
    EXPECT_THAT(error.problems()[0].what, HasSubstr("4 samples"));
    EXPECT_THAT(error.problems()[0].help, HasSubstr("longer recording"));
  }
}

}  // namespace regressor_health_test
}  // namespace torquescope
