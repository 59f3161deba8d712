#include "engine/fit/optim/fuzzy_controller.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace torquescope {
namespace fuzzy_controller_test {

constexpr double inf = std::numeric_limits<double>::infinity();

TEST(ChangeLevels, RiseFromZeroToOneAndTwo) {
  auto const at_rest = change_levels(0.0, 0.0);
  EXPECT_EQ(at_rest.d11, 0.0);
  EXPECT_EQ(at_rest.d22, 0.0);
  auto const wild = change_levels(inf, 1e300);
  EXPECT_EQ(wild.d11, 1.0);
  EXPECT_EQ(wild.d12, 1.0);
  EXPECT_EQ(wild.d21, 2.0);
  EXPECT_EQ(wild.d22, 2.0);
  auto const one = change_levels(1.0, 2.0);
  EXPECT_NEAR(one.d11, 1.0 - 2.0 / std::exp(1.0), 1e-15);
  EXPECT_NEAR(one.d12, 1.0 - 3.0 * std::exp(-2.0), 1e-15);
  EXPECT_EQ(one.d21, 2.0 * one.d11);
  EXPECT_EQ(one.d22, 2.0 * one.d12);
}

TEST(ChangeLevels, AreContinuousWhereTheyAreCutOff) {
  EXPECT_NEAR(change_levels(64.0, 0.0).d11, change_levels(64.0000001, 0.0).d11, 1e-15);
}

// what the seed's tables say when they are read by their labels: see FADE's pairing options
TEST(Pairing, LiterallyFSeesOnlyPCAndCROnlyFC) {
  FuzzyController const literal({.pairing = Pairing::literal});
  EXPECT_EQ(literal(0.7, 0.0).F, literal(0.7, 9.0).F);
  EXPECT_NE(literal(0.7, 0.0).CR, literal(0.7, 9.0).CR);
  EXPECT_EQ(literal(0.0, 0.7).CR, literal(9.0, 0.7).CR);
  EXPECT_NE(literal(0.0, 0.7).F, literal(9.0, 0.7).F);
}

TEST(Pairing, OriginalAndEq9SeeBoth) {
  for (auto const pairing : {Pairing::original, Pairing::eq9}) {
    FuzzyController const controller({.pairing = pairing});
    EXPECT_LT(controller(0.0, 0.0).F, controller(3.0, 0.0).F);
    EXPECT_LT(controller(0.0, 0.0).F, controller(0.0, 3.0).F);
    EXPECT_LT(controller(0.0, 0.0).CR, controller(3.0, 0.0).CR);
    EXPECT_LT(controller(0.0, 0.0).CR, controller(0.0, 3.0).CR);
  }
}

TEST(Pairing, Eq9ReadsTableOneByLabel) {
  FuzzyController const eq9({.pairing = Pairing::eq9});
  EXPECT_EQ(eq9.F_system().second().name, "D2");
  EXPECT_EQ(eq9.F_system().second().means, (std::array{0.1, 0.8, 1.5}));
  EXPECT_EQ(eq9.CR_system().first().name, "D3");
  EXPECT_EQ(eq9.CR_system().first().means, (std::array{0.1, 0.5, 0.9}));
}

TEST(FuzzyController, SmallMeanOfD12MattersLittle) {
  FuzzyController const seed({.d12_small_mean = 0.1});
  FuzzyController const beprados({.d12_small_mean = 0.01});
  double largest = 0.0;
  for (double PC = 0.0; PC < 8.0; PC += 0.1) {
    for (double FC = 0.0; FC < 8.0; FC += 0.1) {
      largest = std::max(largest, std::fabs(seed(PC, FC).F - beprados(PC, FC).F));
      EXPECT_EQ(seed(PC, FC).CR, beprados(PC, FC).CR);
    }
  }
  EXPECT_NEAR(largest, 0.024, 1e-3);
}

struct Extremes {
  double least = 2.0;
  double most = 0.0;
  void take(double value) {
    least = std::min(least, value);
    most = std::max(most, value);
  }
};

// the truncated centroid squeezes both outputs: CR never leaves [.45, .69], whatever the population does. (A plain sum
// over 201 points, as in the prototype, moves these ends by up to .0023: the reason for a trapezoid on 1001.)
TEST(FuzzyController, ReachesOnlyItsMeasuredRange) {
  constexpr double three_digits = 0.5e-3 + 1e-12;
  Extremes narrow_F, wide_F, CR;
  FuzzyController const narrow({.F_universe = 1.0});
  FuzzyController const wide({.F_universe = 2.0});
  for (double PC = 0.0; PC < 10.0; PC += 0.05) {
    for (double FC = 0.0; FC < 10.0; FC += 0.05) {
      narrow_F.take(narrow(PC, FC).F);
      wide_F.take(wide(PC, FC).F);
      CR.take(wide(PC, FC).CR);
    }
  }
  EXPECT_NEAR(narrow_F.least, 0.443, three_digits);
  EXPECT_NEAR(narrow_F.most, 0.612, three_digits);
  EXPECT_NEAR(wide_F.least, 0.624, three_digits);
  EXPECT_NEAR(wide_F.most, 0.924, three_digits);
  EXPECT_NEAR(CR.least, 0.450, three_digits);
  EXPECT_NEAR(CR.most, 0.6865, three_digits);
}

}  // namespace fuzzy_controller_test
}  // namespace torquescope
