// A parameter that ends where it could not go further is no finding: the law is none of the catalogue. Bounds that are
// laws themselves are.

#include "engine/infer/search/reached_bound.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "unit/replicates/clean_records.hpp"

using namespace torquescope;
using namespace torquescope::test;

namespace reached_bound_test {

JointScales scales() {
  JointScales made;
  made.duration_s = 10.0;
  made.peak_speed = 3.0;
  made.position_range = 2.0;
  made.encoder_step = 1e-4;
  made.coulomb_positive = made.coulomb_negative = 1.0;
  made.torque_highest = made.torque_lowest = 2.0;
  return made;
}

std::optional<ReachedBound> bound_of(char const* name, std::vector<double> const& shape,
                                     std::vector<double> const& linear) {
  return reached_bound(*find_effect(name), shape,
                       Eigen::Map<Eigen::VectorXd const>(linear.data(), static_cast<Eigen::Index>(linear.size())),
                       scales());
}

TEST(ReachedBound, IsTheEndOfWhatIsPlausible) {
  auto const bound = bound_of("presliding", {1e-4}, {0.5, 0.0});
  ASSERT_TRUE(bound.has_value());
  EXPECT_EQ(bound->side, BoundSide::lower);
  EXPECT_EQ(bound->parameter, 2U);
  std::string const words = bound_words(*find_effect("presliding"), *bound, JointKind::revolute);
  EXPECT_NE(words.find("presliding distance ends at the least it can be"), std::string::npos) << words;
  EXPECT_EQ(bound_of("presliding", {0.04}, {0.5, 0.0})->side, BoundSide::upper);
  EXPECT_FALSE(bound_of("presliding", {1e-3}, {0.5, 0.0}).has_value());
  EXPECT_EQ(bound_of("directional_efficiency", {2.0, 1.0}, {0.1})->parameter, 1U);
  EXPECT_EQ(bound_of("load_dependent_friction", {1.0, 0.0}, {0.3})->parameter, 0U)
      << "a linear one with a bound of its own";
}

TEST(ReachedBound, IsNoneWhereTheBoundIsALaw) {
  EXPECT_FALSE(bound_of("presliding", {1e-3}, {1.0, 0.0}).has_value()) << "all of the Coulomb friction builds up";
  EXPECT_FALSE(bound_of("stribeck", {0.1, 2.0}, {0.5}).has_value()) << "a bell";
  EXPECT_FALSE(bound_of("end_stop", {0.2, 1.0}, {5.0, 0.0}).has_value()) << "a spring";
  EXPECT_FALSE(bound_of("load_dependent_friction", {1.0, 0.0}, {0.1}).has_value()) << "all inertia behind the gear";
  EXPECT_FALSE(bound_of("clipping", {2.0, 2.0}, {1.0}).has_value());
  EXPECT_FALSE(bound_of("joint_elasticity", {30.0, 0.05, 0.0}, {0.01}).has_value()) << "a spring that does not harden";
}

}  // namespace reached_bound_test
