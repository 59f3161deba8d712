#include "engine/statistics/multiple_testing.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "engine/base/random_stream.hpp"

namespace torquescope {
namespace multiple_testing_test {

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

std::vector<std::size_t> found_at(double level, std::vector<double> const& q) {
  std::vector<std::size_t> found;
  for (std::size_t i = 0; i < q.size(); ++i)
    if (q[i] <= level) found.push_back(i);
  return found;
}

TEST(HierarchicalQ, FindsMembersOfSelectedFamiliesOnly) {
  std::vector<double> const p{1e-6, 0.2, 1e-5, 0.04, 0.6, 0.7};
  std::vector<std::string> const family{"reversal", "velocity", "reversal", "velocity", "time", "order"};
  // velocity: Simes 0.08, and twice that over four families
  EXPECT_EQ(found_at(0.05, hierarchical_q(p, family)), (std::vector<std::size_t>{0, 2}));
}

TEST(HierarchicalQ, PaysForSelectingFewFamilies) {
  // one of four families selected: its members are tested at a quarter of the level
  std::vector<double> const p{0.001, 0.02, 0.5, 0.6, 0.7};
  std::vector<std::string> const family{"a", "a", "b", "c", "d"};
  std::vector<double> const q = hierarchical_q(p, family);
  EXPECT_EQ(found_at(0.05, q), (std::vector<std::size_t>{0}));  // 0.02 <= 0.05 but above 0.05 / 4
  EXPECT_DOUBLE_EQ(q[0], 0.002 * 4);
  EXPECT_DOUBLE_EQ(q[1], 0.02 * 4);
}

// the two steps as Benjamini and Bogomolov write them, at one level: an oracle without levels to search
std::vector<std::size_t> two_steps(double level, std::vector<double> const& p, std::vector<std::string> const& family) {
  std::map<std::string, std::vector<std::size_t>> members;
  for (std::size_t i = 0; i < p.size(); ++i) members[family[i]].push_back(i);
  auto const step_up = [](std::vector<std::pair<double, std::size_t>> tests, double at) {
    std::sort(tests.begin(), tests.end());
    std::size_t count = 0;
    for (std::size_t k = 0; k < tests.size(); ++k)
      if (tests[k].first <= at * static_cast<double>(k + 1) / static_cast<double>(tests.size())) count = k + 1;
    std::vector<std::size_t> rejected;
    for (std::size_t k = 0; k < count; ++k) rejected.push_back(tests[k].second);
    return rejected;
  };
  std::vector<std::vector<std::size_t>> families;
  std::vector<std::pair<double, std::size_t>> simes;
  for (auto const& [name, indices] : members) {
    std::vector<double> own;
    for (std::size_t i : indices) own.push_back(p[i]);
    std::sort(own.begin(), own.end());
    double least = 1.0;
    for (std::size_t k = 0; k < own.size(); ++k)
      least = std::min(least, own[k] * static_cast<double>(own.size()) / static_cast<double>(k + 1));
    simes.emplace_back(least, families.size());
    families.push_back(indices);
  }
  auto const selected = step_up(simes, level);
  std::vector<std::size_t> found;
  for (std::size_t f : selected) {
    std::vector<std::pair<double, std::size_t>> tests;
    for (std::size_t i : families[f]) tests.emplace_back(p[i], i);
    double const share = static_cast<double>(selected.size()) / static_cast<double>(families.size());
    for (std::size_t i : step_up(tests, level * share)) found.push_back(i);
  }
  std::sort(found.begin(), found.end());
  return found;
}

TEST(HierarchicalQ, FindsAtEveryLevelWhatTheTwoStepsFind) {
  for (std::uint32_t set = 0; set < 300; ++set) {
    RandomStream stream({7, set, RandomDomain::test}, 0, 0);
    std::vector<double> p;
    std::vector<std::string> family;
    for (int i = 0; i < 25; ++i) {
      // many small ones, so that several families are selected
      p.push_back(std::pow(stream.uniform(), 4.0) + 1e-12);
      family.emplace_back(1, static_cast<char>('a' + static_cast<int>(6.0 * stream.uniform())));
    }
    std::vector<double> const q = hierarchical_q(p, family);
    for (double const level : {0.001, 0.01, 0.05, 0.1, 0.3, 0.7})
      EXPECT_EQ(found_at(level, q), two_steps(level, p, family)) << "set " << set << ", level " << level;
  }
}

}  // namespace multiple_testing_test
}  // namespace torquescope
