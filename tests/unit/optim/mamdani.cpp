#include "engine/fit/optim/mamdani.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "engine/base/random_stream.hpp"

namespace torquescope {
namespace mamdani_test {

enum Set { S, M, B };
struct Rule {
  Set first, second, conclusion;
};
// table 2 of the seed, as printed
constexpr Rule table_2[9] = {{S, S, S}, {S, M, M}, {S, B, B}, {M, S, M}, {M, M, M},
                             {M, B, B}, {B, S, B}, {B, M, B}, {B, B, B}};

FuzzyVariable const d11{"d11", 1.0, 0.25, {0.05, 0.5, 0.9}};
FuzzyVariable const d12{"d12", 1.0, 0.35, {0.1, 0.5, 0.9}};
FuzzyVariable const F{"F", 2.0, 0.5, {0.3, 0.6, 0.9}};

// Mamdani's inference word by word: nine implied sets, their maximum, its centre of gravity on a fine grid
double nine_rule_centroid(double a, double b) {
  auto const in_a = memberships(d11, a);
  auto const in_b = memberships(d12, b);
  constexpr int n = 20000;
  double area = 0.0;
  double moment = 0.0;
  for (int p = 0; p < n; ++p) {
    double const y = F.top * (p + 0.5) / n;
    auto const in_y = memberships(F, y);
    double aggregated = 0.0;
    for (auto const& rule : table_2) {
      double const firing = std::min(in_a[rule.first], in_b[rule.second]);
      aggregated = std::max(aggregated, std::min(firing, in_y[rule.conclusion]));
    }
    area += aggregated;
    moment += aggregated * y;
  }
  return moment / area;
}

TEST(FadeRules, ClipThreeSetsExactlyAsNineRulesDo) {
  for (std::uint32_t draw = 0; draw < 5000; ++draw) {
    RandomStream random({9, 0, RandomDomain::test}, draw, 0);
    auto const a = memberships(d11, random.uniform());
    auto const b = memberships(d12, random.uniform());
    SetLevels levels{};
    for (auto const& rule : table_2) {
      levels[rule.conclusion] = std::max(levels[rule.conclusion], std::min(a[rule.first], b[rule.second]));
    }
    EXPECT_EQ(clip_levels(a, b), levels);
  }
}

TEST(MamdaniSystem, EqualsNineRuleInference) {
  MamdaniSystem const on_grid(d11, d12, F, Defuzzification::centroid, 1001);
  MamdaniSystem const closed(d11, d12, F, Defuzzification::centroid_closed, 1001);
  for (double const a : {0.0, 0.2, 0.264, 0.5, 0.77, 1.0}) {
    for (double const b : {0.0, 0.3, 0.6, 1.0}) {
      double const oracle = nine_rule_centroid(a, b);
      EXPECT_NEAR(on_grid(a, b), oracle, 2e-6);
      EXPECT_NEAR(closed(a, b), oracle, 1e-7);
    }
  }
}

TEST(MamdaniSystem, GrowsWithBothInputs) {
  for (auto const how : {Defuzzification::centroid_closed, Defuzzification::weighted_average}) {
    MamdaniSystem const system(d11, d12, F, how, 101);
    for (double const small : {0.1, 0.3, 0.5}) {
      EXPECT_LT(system(small, small), system(small + 0.4, small));
      EXPECT_LT(system(small, small), system(small, small + 0.4));
    }
  }
}

}  // namespace mamdani_test
}  // namespace torquescope
