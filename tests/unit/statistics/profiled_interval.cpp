// An instant's interval reaches as far as the fit does not notice: over plateaus, to jumps, to the bounds, and on a
// parabola it is the tangent's.

#include "engine/fit/statistics/profiled_interval.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace torquescope {
namespace profiled_interval_test {

ProfiledParameter at(double value, double first_step = 1e-3) { return {value, 0.0, 10.0, first_step}; }

TEST(ProfiledInterval, OfAParabolaIsThatOfItsCurvature) {
  // standard deviation 0.2: noise / (2 * half of the curvature)
  auto const gain = [](double s) { return 100.0 - 25.0 * (s - 4.0) * (s - 4.0); };
  auto const [from, to] = profiled_interval(at(4.0), 1.0, 0.0, gain);
  EXPECT_NEAR(from, 4.0 - 1.96 * 0.2, 0.01);
  EXPECT_NEAR(to, 4.0 + 1.96 * 0.2, 0.01);
}

TEST(ProfiledInterval, AddsWhatALawMayHideInSquares) {
  // of a parabola a shift costs its square times the curvature: the two parts of the interval add up like sides of a
  // right triangle
  auto const gain = [](double s) { return 100.0 - 25.0 * (s - 4.0) * (s - 4.0); };
  auto const [from, to] = profiled_interval(at(4.0), 1.0, 9.0, gain);
  EXPECT_NEAR(from, 4.0 - std::hypot(1.96 * 0.2, 0.6), 0.02);
  EXPECT_NEAR(to, 4.0 + std::hypot(1.96 * 0.2, 0.6), 0.02);
}

TEST(ProfiledInterval, ReachesOverTheWholeRest) {
  // nothing moves between 3 and 6: any instant of that explains the same
  auto const gain = [](double s) { return s < 3.0 ? 50.0 : s > 6.0 ? 80.0 : 100.0; };
  auto const [from, to] = profiled_interval(at(5.9), 1.0, 0.0, gain);
  EXPECT_NEAR(from, 3.0, 0.06);
  EXPECT_NEAR(to, 6.0, 0.06);
  EXPECT_LE(from, 3.0) << "what is not noticed is inside";
  EXPECT_GE(to, 6.0);
}

TEST(ProfiledInterval, EndsAtTheBoundsAndHoldsAValueBeyondThem) {
  auto const flat = [](double) { return 1.0; };
  auto const inside = profiled_interval(at(2.0), 1.0, 0.0, flat);
  EXPECT_EQ(inside.first, 0.0);
  EXPECT_EQ(inside.second, 10.0);
  auto const beyond = profiled_interval(at(11.0), 1.0, 0.0, flat);
  EXPECT_EQ(beyond.first, 0.0);
  EXPECT_EQ(beyond.second, 11.0);
}

TEST(ProfiledInterval, AFirstStepThatIsTooLongIsHalved) {
  auto const gain = [](double s) { return 100.0 - 25.0 * (s - 4.0) * (s - 4.0); };
  auto const [from, to] = profiled_interval(at(4.0, 5.0), 1.0, 0.0, gain);
  EXPECT_NEAR(from, 4.0 - 0.392, 0.1);
  EXPECT_NEAR(to, 4.0 + 0.392, 0.1);
}

}  // namespace profiled_interval_test
}  // namespace torquescope
