#include "engine/fit/optim/bound_repair.hpp"

#include <gtest/gtest.h>

#include <array>
#include <limits>
#include <vector>

namespace torquescope {
namespace bound_repair_test {

Bounds const bounds{{-1.0, 2.0}, {1.0, 6.0}};
std::array<double, 2> const target{0.5, 3.0};
constexpr std::array repairs{BoundRepair::midpoint, BoundRepair::clip, BoundRepair::reflect, BoundRepair::random};

std::array<double, 2> repaired(BoundRepair repair, double first, double second) {
  std::array<double, 2> trial{first, second};
  RandomStream random({4, 0, RandomDomain::test}, 0, 0);
  repair_bounds(repair, bounds, target, random, trial);
  return trial;
}

TEST(BoundRepair, LeavesWhatIsInsideAlone) {
  for (auto const repair : repairs) {
    EXPECT_EQ(repaired(repair, -1.0, 6.0), (std::array{-1.0, 6.0}));
    EXPECT_EQ(repaired(repair, 0.1, 2.5), (std::array{0.1, 2.5}));
  }
}

TEST(BoundRepair, EndsInsideWhateverTheMutantWas) {
  constexpr double inf = std::numeric_limits<double>::infinity();
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  for (auto const repair : repairs) {
    for (double const wild : {1.0000001, -1.5, 17.3, -1e9, 1e300, -1e300, inf, -inf, nan}) {
      auto const trial = repaired(repair, wild, wild);
      for (std::size_t j = 0; j < 2; ++j) {
        EXPECT_GE(trial[j], bounds.lower[j]) << wild;
        EXPECT_LE(trial[j], bounds.upper[j]) << wild;
      }
    }
  }
}

TEST(BoundRepair, MidpointIsHalfwayFromTheTarget) {
  EXPECT_EQ(repaired(BoundRepair::midpoint, 4.0, 1.0), (std::array{0.75, 2.5}));
}

TEST(BoundRepair, ClipIsTheBound) { EXPECT_EQ(repaired(BoundRepair::clip, 4.0, 1.0), (std::array{1.0, 2.0})); }

TEST(BoundRepair, ReflectMirrorsAsOftenAsNeeded) {
  EXPECT_EQ(repaired(BoundRepair::reflect, 1.25, 1.5), (std::array{0.75, 2.5}));
  EXPECT_EQ(repaired(BoundRepair::reflect, -1.25, 7.0), (std::array{-0.75, 5.0}));
  // 1 + 2 + 0.5: up to 1, down to -1, up again by 0.5
  EXPECT_EQ(repaired(BoundRepair::reflect, 3.5, 3.0)[0], -0.5);
}

TEST(BoundRepair, RandomCoversTheBox) {
  double least = 1.0;
  double most = -1.0;
  for (std::uint32_t draw = 0; draw < 1000; ++draw) {
    std::array<double, 2> trial{5.0, 3.0};
    RandomStream random({5, 0, RandomDomain::test}, draw, 0);
    repair_bounds(BoundRepair::random, bounds, target, random, trial);
    least = std::min(least, trial[0]);
    most = std::max(most, trial[0]);
    EXPECT_EQ(trial[1], 3.0);
  }
  EXPECT_LT(least, -0.98);
  EXPECT_GT(most, 0.98);
}

}  // namespace bound_repair_test
}  // namespace torquescope
