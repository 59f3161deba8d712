#include "engine/diagnose/multiple_testing.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "engine/base/random_stream.hpp"

namespace torquescope {
namespace {

TEST(BenjaminiHochberg, GivesTheTextbookExample) {
  // Benjamini, Hochberg 1995, section 3.2: 15 hypotheses, 4 rejected at 5 %
  std::vector<double> const p{0.0001, 0.0004, 0.0019, 0.0095, 0.0201, 0.0278, 0.0298, 0.0344,
                              0.0459, 0.3240, 0.4262, 0.5719, 0.6528, 0.7590, 1.0000};
  auto const q = benjamini_hochberg_q(p);
  EXPECT_EQ(std::count_if(q.begin(), q.end(), [](double value) { return value <= 0.05; }), 4);
  EXPECT_NEAR(q[3], 0.0095 * 15 / 4, 1e-12);
}

TEST(BenjaminiHochberg, QNeverFallsAsPGrows) {
  std::vector<double> p;
  RandomStream stream({5, 0, RandomDomain::test}, 0, 0);
  for (int i = 0; i < 200; ++i) p.push_back(stream.uniform() + 1e-12);
  auto const q = benjamini_hochberg_q(p);
  for (std::size_t a = 0; a < p.size(); ++a) {
    EXPECT_GE(q[a], p[a] * (1 - 1e-12));
    for (std::size_t b = 0; b < p.size(); ++b) {
      bool const in_order = p[a] >= p[b] || q[a] <= q[b];
      EXPECT_TRUE(in_order) << p[a] << " " << p[b];
    }
  }
}

TEST(BenjaminiHochberg, HoldsItsRateOnNullTests) {
  int any = 0;
  int const sets = 4000;
  for (std::uint32_t set = 0; set < static_cast<std::uint32_t>(sets); ++set) {
    std::vector<double> p;
    for (std::uint32_t i = 0; i < 20; ++i)
      p.push_back(RandomStream({6, set, RandomDomain::test}, 0, i).uniform() + 1e-15);
    auto const q = benjamini_hochberg_q(p);
    any += *std::min_element(q.begin(), q.end()) <= 0.05 ? 1 : 0;
  }
  // all hypotheses true: the rate of any discovery is exactly the level for independent tests
  EXPECT_NEAR(any, 0.05 * sets, 5 * std::sqrt(sets * 0.05 * 0.95));
}

TEST(SimesP, OfOneTestIsItsP) {
  EXPECT_EQ(simes_p(std::vector<double>{0.03}), 0.03);
  EXPECT_DOUBLE_EQ(simes_p(std::vector<double>{0.03, 0.04}), 0.04);
  EXPECT_DOUBLE_EQ(simes_p(std::vector<double>{0.01, 0.9}), 0.02);
}

TEST(HierarchicalTest, NamesMembersOfSelectedFamiliesOnly) {
  std::vector<double> const p{1e-6, 0.2, 1e-5, 0.04, 0.6, 0.7};
  std::vector<std::string> const family{"reversal", "velocity", "reversal", "velocity", "time", "order"};
  auto const tests = hierarchical_test(p, family, 0.05);
  ASSERT_EQ(tests.size(), 4u);
  EXPECT_TRUE(tests[0].selected);
  EXPECT_EQ(tests[0].rejected, (std::vector<std::size_t>{0, 2}));
  EXPECT_FALSE(tests[1].selected);  // 0.08 over four families
  EXPECT_TRUE(tests[1].rejected.empty());
}

TEST(HierarchicalTest, PaysForSelectingFewFamilies) {
  // one of four families selected: its members are tested at a quarter of the level
  std::vector<double> const p{0.001, 0.02, 0.5, 0.6, 0.7};
  std::vector<std::string> const family{"a", "a", "b", "c", "d"};
  auto const tests = hierarchical_test(p, family, 0.05);
  EXPECT_EQ(tests[0].rejected, (std::vector<std::size_t>{0}));  // 0.02 <= 0.05 but above 0.05 / 4
}

}  // namespace
}  // namespace torquescope
