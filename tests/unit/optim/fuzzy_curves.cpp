#include "engine/fit/optim/fuzzy_curves.hpp"

#include <gtest/gtest.h>

namespace torquescope {
namespace fuzzy_curves_test {

TEST(MembershipCurves, CoverTheSixVariablesOverTheirUniverses) {
  FuzzyController const controller({});
  auto const all = membership_curves(controller, 201);
  std::vector<std::string> names;
  for (auto const& curves : all) {
    names.push_back(curves.variable.name);
    EXPECT_EQ(curves.x.front(), 0.0);
    EXPECT_EQ(curves.x.back(), curves.variable.top);
    for (std::size_t k = 0; k < 3; ++k) {
      ASSERT_EQ(curves.memberships[k].size(), 201u);
      EXPECT_EQ(curves.memberships[k][77], membership(curves.variable, fuzzy_sets[k], curves.x[77]));
    }
  }
  EXPECT_EQ(names, (std::vector<std::string>{"d11", "d12", "F", "d21", "d22", "CR"}));
}

TEST(MembershipCurves, PeakAtOneAndFallToExpMinusHalfOneSigmaAway) {
  FuzzyVariable const variable{"x", 1.0, 0.25, {0.05, 0.5, 0.9}};
  EXPECT_EQ(membership(variable, FuzzySet::middle, 0.5), 1.0);
  EXPECT_NEAR(membership(variable, FuzzySet::middle, 0.75), 0.60653065971263342, 1e-15);
  EXPECT_EQ(membership(variable, FuzzySet::middle, 0.75), membership(variable, FuzzySet::middle, 0.25));
}

TEST(DecisionSurface, IsTheSystemAtEveryPairOfInputs) {
  FuzzyController const controller({});
  auto const surface = decision_surface(controller.CR_system(), 11);
  ASSERT_EQ(surface.output.size(), 121u);
  EXPECT_EQ(surface.first.back(), 2.0);
  EXPECT_EQ(surface.output[3 * 11 + 8], controller.CR_system()(surface.first[3], surface.second[8]));
  EXPECT_EQ(surface.output_name, "CR");
}

}  // namespace fuzzy_curves_test
}  // namespace torquescope
