#include "engine/fit/optim/stop_rules.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "support/optimise.hpp"

namespace torquescope {
namespace stop_rules_test {

Bounds const box = testing::cube(2, -1.0, 1.0);

// the loop of a caller: truncates the last batch
StopReason run(Optimiser& search, StopRules const& rules, testing::Fitness const& fitness,
               double seconds_per_batch = 0.0) {
  double elapsed_s = 0.0;
  for (;;) {
    auto batch = testing::asked_and_evaluated(search, fitness);
    std::size_t const rows = allowed_rows(rules, search.progress(), batch.fitness.size());
    search.tell(batch.rows().rows(0, rows), std::span(batch.fitness).first(rows));
    elapsed_s += seconds_per_batch;
    if (auto const reason = reason_to_stop(rules, search, box, elapsed_s)) return *reason;
  }
}

double sphere(std::span<double const> x) { return x[0] * x[0] + x[1] * x[1]; }

std::unique_ptr<Optimiser> de() {
  return testing::make_optimiser("de", box, {11, 0}, {{"population", std::int64_t{10}}});
}

StopRules without_limit() {
  StopRules rules;
  rules.generations = 5000;
  return rules;
}

TEST(StopRules, GenerationsCountAfterTheInitialPopulation) {
  auto const search = de();
  StopRules rules;
  rules.generations = 7;
  EXPECT_EQ(run(*search, rules, sphere), StopReason::generations);
  EXPECT_EQ(search->progress().evaluations, 80);
}

TEST(StopRules, EvaluationsAreSpentExactly) {
  for (std::int64_t const budget : {3, 10, 11, 57}) {
    auto const search = de();
    StopRules rules = without_limit();
    rules.evaluations = budget;
    EXPECT_EQ(run(*search, rules, sphere), StopReason::evaluations);
    EXPECT_EQ(search->progress().evaluations, budget);
  }
}

TEST(StopRules, TargetIsAbsoluteAndMayBeNegative) {
  auto const search = de();
  StopRules rules = without_limit();
  rules.target = -99.9;
  EXPECT_EQ(run(*search, rules, [](auto x) { return sphere(x) - 100.0; }), StopReason::target);
  EXPECT_LE(search->progress().best_fitness, -99.9);
  EXPECT_GT(search->progress().generation, 0);
}

// the rules that look at differences must not see an offset, whatever its sign
TEST(StopRules, RangeAndStagnationIgnoreAnOffset) {
  StopRules range = without_limit();
  range.fitness_range = 0x1p-10;
  StopRules stagnation = without_limit();
  stagnation.stagnation = 5;
  for (auto const& rules : {range, stagnation}) {
    std::int64_t reference = -1;
    for (double const offset : {0.0, -4096.0, 4096.0}) {
      auto const search = de();
      // multiples of 2^-20: the offset is added without rounding
      auto const reason =
          run(*search, rules, [&](auto x) { return std::round(sphere(x) * 0x1p20) * 0x1p-20 + offset; });
      EXPECT_EQ(reason, rules.stagnation > 0 ? StopReason::stagnation : StopReason::fitness_range);
      if (reference < 0) reference = search->progress().generation;
      EXPECT_EQ(search->progress().generation, reference);
    }
  }
}

TEST(StopRules, WidthIsAShareOfTheBox) {
  auto const search = de();
  StopRules rules = without_limit();
  rules.width = 1e-3;
  EXPECT_EQ(run(*search, rules, sphere), StopReason::width);
  for (std::size_t i = 1; i < search->population().rows(); ++i) {
    EXPECT_NEAR(search->population()(i, 0), search->population()(0, 0), 2e-3);
  }
}

TEST(StopRules, StagnationCountsGenerationsWithoutImprovement) {
  auto const search = de();
  StopRules rules = without_limit();
  rules.stagnation = 4;
  EXPECT_EQ(run(*search, rules, [](auto) { return 1.0; }), StopReason::stagnation);
  EXPECT_EQ(search->progress().generation, 4);
  EXPECT_EQ(search->progress().last_improvement, 0);
}

TEST(StopRules, StagnationStartsAnewWithEveryImprovement) {
  auto const search = de();
  StopRules rules = without_limit();
  rules.stagnation = 8;
  EXPECT_EQ(run(*search, rules, sphere), StopReason::stagnation);
  EXPECT_GT(search->progress().last_improvement, 8);
  EXPECT_EQ(search->progress().generation, search->progress().last_improvement + 8);
}

TEST(StopRules, NonfiniteFitnessIsNeitherTargetNorSmallRange) {
  auto const search = de();
  StopRules rules;
  rules.generations = 5;
  rules.fitness_range = 1e9;
  rules.target = 1e300;
  EXPECT_EQ(run(*search, rules, [](auto) { return std::numeric_limits<double>::quiet_NaN(); }),
            StopReason::generations);
}

TEST(StopRules, WallClockIsTheCallersClock) {
  auto const search = de();
  StopRules rules = without_limit();
  rules.wall_clock_s = 3.0;
  EXPECT_EQ(run(*search, rules, sphere, 1.0), StopReason::wall_clock);
  EXPECT_EQ(search->progress().generation, 2);
}

TEST(StopRules, SearchWithoutEndIsAJobError) {
  StopRules rules;
  EXPECT_FALSE(rules.endless({}).has_value());
  rules.generations = 0;
  rules.target = 1e-3;
  ASSERT_TRUE(rules.endless({}).has_value());
  EXPECT_EQ(rules.endless({})->help, "set one of them, for example generations = 100");
  rules.wall_clock_s = 60.0;
  EXPECT_FALSE(rules.endless({}).has_value());
}

TEST(StopRules, AreReadFromTheJob) {
  StopRules rules;
  std::vector<Problem> problems;
  Section const section{"stop", {}, {{"evaluations", std::int64_t{3000}}, {"target", -5.0}, {"width", 2.0}}};
  StopRules::table().apply(section, rules, problems);
  EXPECT_EQ(rules.evaluations, 3000);
  EXPECT_EQ(rules.target, -5.0);
  ASSERT_EQ(problems.size(), 1u);
  EXPECT_EQ(problems[0].key, "stop.width");
}

TEST(StopRules, AreStricterWhereTheyMightEndASearchEarlier) {
  StopRules const before{.target = 1e-3, .fitness_range = 1e-2, .width = 0.1, .stagnation = 9, .generations = 50};
  EXPECT_TRUE(stricter_rules(before, before).empty());
  StopRules now{.target = 1e-4, .fitness_range = 0.0, .width = 0.05, .stagnation = 0, .generations = 51};
  now.wall_clock_s = 1.0;
  EXPECT_TRUE(stricter_rules(now, before).empty());
  EXPECT_EQ(stricter_rules(before, now),
            (std::vector<std::string>{"target", "fitness_range", "width", "stagnation", "generations"}));
  StopRules limited = before;
  limited.evaluations = 1'000'000;
  EXPECT_EQ(stricter_rules(limited, before), (std::vector<std::string>{"evaluations"}));
  EXPECT_TRUE(stricter_rules(before, limited).empty());
}

TEST(StopReason, HasTheNameOfItsOption) {
  std::vector<std::string> keys;
  for (auto const& option : StopRules::table().describe()) keys.push_back(option.key);
  for (auto const reason : {StopReason::target, StopReason::fitness_range, StopReason::width, StopReason::stagnation,
                            StopReason::generations, StopReason::evaluations}) {
    EXPECT_NE(std::find(keys.begin(), keys.end(), to_string(reason)), keys.end()) << to_string(reason);
  }
  EXPECT_EQ(to_string(StopReason::wall_clock), "wall_clock");
}

}  // namespace stop_rules_test
}  // namespace torquescope
