// what float32 promises: a fitness near that of float64, its error said beforehand, refused where noise does not hide
// it
#include "engine/fit/problem/single_precision.hpp"

#include <gmock/gmock.h>

#include "engine/fit/problem/fitness_choice.hpp"
#include "unit/problem/joint_data.hpp"

namespace torquescope {
namespace single_precision_test {

Bounds unit_box() { return {std::vector<double>(4, -1.0), std::vector<double>(4, 1.0)}; }

SinglePrecisionCheck check_of(RegressionData const& data) {
  return check_single_precision(data, SufficientStatistics(data.phi, data.tau));
}

TEST(SinglePrecision, DiffersFromDoubleByNoMoreThanItsCheckSaysAroundLeastSquares) {
  auto const data = test::seed_data(100.0, 0.3);
  auto const check = check_of(data);
  ASSERT_TRUE(check.usable());
  EXPECT_GT(check.error, 0.0);
  EXPECT_LT(check.error, 1e-6);
  SinglePrecisionObjective const single(data, unit_box());
  ResidualObjective const twice(data, unit_box());
  Eigen::VectorXd const v = test::fit("ols", data).parameters;
  Workspace workspace;
  double in_float = 0.0, in_double = 0.0;
  single.evaluate({v.data(), 1, 4}, {&in_float, 1}, workspace);
  twice.evaluate({v.data(), 1, 4}, {&in_double, 1}, workspace);
  // least squares by two ways: they agree to rounding, the check's error to a hundredth of itself
  EXPECT_LE(std::abs(in_float / in_double - 1.0), 1.01 * check.error + 1e-12);
  EXPECT_NE(in_float, in_double);
}

TEST(SinglePrecision, IsTheSumForSse) {
  auto const data = test::seed_data(30.0, 0.3);
  std::vector<double> const v{0.1, -0.2, 0.3, -0.4};
  Workspace workspace;
  double mse = 0.0, sse = 0.0;
  SinglePrecisionObjective(data, unit_box()).evaluate({v.data(), 1, 4}, {&mse, 1}, workspace);
  SinglePrecisionObjective(data, unit_box(), FitnessScale::sse).evaluate({v.data(), 1, 4}, {&sse, 1}, workspace);
  EXPECT_EQ(sse / 3000.0, mse);
}

TEST(SinglePrecision, IsRefusedWithoutNoise) {
  EXPECT_FALSE(check_of(test::seed_data(20.0, 0.0)).usable());
  double const rms = 0.18;  // of the seed's torque, about
  EXPECT_FALSE(check_of(test::seed_data(20.0, 2e-4 * rms)).usable());
  EXPECT_TRUE(check_of(test::seed_data(20.0, 5e-3 * rms)).usable());
}

TEST(SinglePrecision, IsRefusedWhereColumnsAreDependent) {
  auto data = test::seed_data(20.0, 0.3);
  data.phi.col(1) = data.phi.col(0);
  EXPECT_FALSE(check_of(data).usable());
}

TEST(SinglePrecision, SaysItsErrorInTheLog) {
  ObjectiveOptions options;
  options.precision = "float32";
  EXPECT_TRUE(wants_statistics(options, 4, 1));
  auto const choice = single_precision_choice(options, {0.02, 3e-8});
  EXPECT_TRUE(choice.in_float32);
  EXPECT_FALSE(choice.from_statistics);
  EXPECT_THAT(choice.words, testing::HasSubstr("every sample (auto) in float32: its MSE is within 3e-08 of float64's"));
  EXPECT_THAT(choice.words, testing::HasSubstr("leaves 2.0e-02 of the torque"));
}

}  // namespace single_precision_test
}  // namespace torquescope
