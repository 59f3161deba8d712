// Where an effect acts is said as the interval, or the two, that match its acting samples best among all there are.

#include "engine/infer/locate/acting_region.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "engine/base/random_stream.hpp"

namespace torquescope {
namespace acting_region_test {

using Interval = std::pair<double, double>;

struct Samples {
  Eigen::VectorXd at, energy;
};

// every sample is a cell of its own as long as there are few: the strongest that hold 80 %
std::vector<bool> acting(Samples const& samples) {
  std::vector<Eigen::Index> order(static_cast<std::size_t>(samples.at.size()));
  std::iota(order.begin(), order.end(), Eigen::Index{0});
  std::sort(order.begin(), order.end(), [&](auto a, auto b) { return samples.energy[a] > samples.energy[b]; });
  std::vector<bool> acts(order.size());
  double held = 0.0;
  for (auto k : order) {
    if (held >= 0.8 * samples.energy.sum()) break;
    acts[static_cast<std::size_t>(k)] = true;
    held += samples.energy[k];
  }
  return acts;
}

double jaccard(Samples const& samples, std::vector<bool> const& acts, std::vector<Interval> const& intervals) {
  double both = 0.0, either = 0.0;
  for (Eigen::Index k = 0; k < samples.at.size(); ++k) {
    bool const acts_here = acts[static_cast<std::size_t>(k)];
    bool const covered = std::any_of(intervals.begin(), intervals.end(), [&](Interval const& one) {
      return samples.at[k] >= one.first && samples.at[k] <= one.second;
    });
    both += acts_here && covered ? 1.0 : 0.0;
    either += acts_here || covered ? 1.0 : 0.0;
  }
  return both / either;
}

Samples drawn(std::uint32_t set, Eigen::Index n) {
  RandomStream stream({61, set, RandomDomain::test}, 0, 0);
  Samples samples{Eigen::VectorXd(n), Eigen::VectorXd(n)};
  for (double& value : samples.at) value = stream.normal();
  for (double& value : samples.energy) value = std::pow(stream.normal(), 4);
  return samples;
}

TEST(ActingRegion, IsTheBestOfAllIntervalsAndOfAllPairs) {
  for (std::uint32_t set = 0; set < 60; ++set) {
    Samples const samples = drawn(set, 12);
    auto const acts = acting(samples);
    double best_one = 0.0, best_two = 0.0;
    for (double a : samples.at)
      for (double b : samples.at) {
        best_one = std::max(best_one, jaccard(samples, acts, {{a, b}}));
        for (double c : samples.at)
          for (double d : samples.at) best_two = std::max(best_two, jaccard(samples, acts, {{a, b}, {c, d}}));
      }
    ActingRegion const found = acting_region(samples.at, samples.energy);
    EXPECT_NEAR(jaccard(samples, acts, {found.interval}), best_one, 1e-12) << set;
    bool const wants_two = best_two > 1.25 * best_one;
    EXPECT_EQ(found.intervals.size(), wants_two ? 2U : 1U) << set;
    EXPECT_NEAR(jaccard(samples, acts, found.intervals), wants_two ? best_two : best_one, 1e-12) << set;
    EXPECT_TRUE(std::is_sorted(found.intervals.begin(), found.intervals.end()));
  }
}

// drag that grows with the square of the speed: strong near both ends
TEST(ActingRegion, OfWhatActsAtBothEndsIsTwo) {
  Eigen::VectorXd const v = Eigen::VectorXd::LinSpaced(4001, -1.0, 1.0);
  ActingRegion const found = acting_region(v, v.array().pow(4));
  ASSERT_EQ(found.intervals.size(), 2U);
  double const edge = std::pow(0.2, 0.2);  // the integral of v^4 beyond it is 80 % of the whole
  EXPECT_NEAR(found.intervals[0].second, -edge, 0.01);
  EXPECT_NEAR(found.intervals[1].first, edge, 0.01);
  EXPECT_NEAR(std::max(-found.interval.first, found.interval.second), 1.0, 1e-12);
}

TEST(ActingRegion, OfAHumpIsOneIntervalRoundIt) {
  Eigen::VectorXd const v = Eigen::VectorXd::LinSpaced(4001, -1.0, 1.0);
  ActingRegion const found = acting_region(v, (-(v.array() / 0.1).square()).exp());
  ASSERT_EQ(found.intervals.size(), 1U);
  EXPECT_EQ(found.intervals[0], found.interval);
  EXPECT_NEAR(found.interval.first, -found.interval.second, 0.01);
  EXPECT_NEAR(found.interval.second, 0.0906, 0.01);  // erf(x / 0.1) = 0.8
}

TEST(ActingRegion, DoesNotDependOnTheOrderOfTheSamples) {
  Samples const samples = drawn(99, 3000);
  ActingRegion const forwards = acting_region(samples.at, samples.energy);
  ActingRegion const backwards = acting_region(samples.at.reverse(), samples.energy.reverse());
  EXPECT_EQ(forwards.interval, backwards.interval);
  EXPECT_EQ(forwards.intervals, backwards.intervals);
}

}  // namespace acting_region_test
}  // namespace torquescope
