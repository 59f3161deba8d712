#include "engine/problem/fitness_choice.hpp"

#include <gmock/gmock.h>

#include "unit/problem/joint_data.hpp"

namespace torquescope {
namespace {

using testing::HasSubstr;

FitnessChoice choose(std::string const& fitness, double noise, std::int64_t evaluations,
                     std::string const& loss = "squares") {
  auto const data = test::seed_data(10.0, noise);
  SufficientStatistics const statistics(data.phi, data.tau);
  return choose_fitness({loss, 0.0, "mse", fitness}, &statistics, evaluations);
}

TEST(FitnessChoice, TakesStatisticsWhereTheyAreExactAndRepaid) {
  EXPECT_TRUE(choose("auto", 0.3, 90'900).from_statistics);
  EXPECT_THAT(choose("auto", 0.3, 90'900).words, HasSubstr("sufficient statistics (auto)"));
  EXPECT_FALSE(choose("auto", 0.3, 10).from_statistics);
  EXPECT_THAT(choose("auto", 0.3, 10).words, HasSubstr("10 evaluations do not repay statistics, 52 would"));
  EXPECT_TRUE(choose("gram", 0.3, 10).from_statistics);
}

TEST(FitnessChoice, FallsBackToEverySampleAndSaysWhy) {
  for (std::string const fitness : {"auto", "gram"}) {
    auto const clean = choose(fitness, 0.0, 90'900);
    EXPECT_FALSE(clean.from_statistics);
    EXPECT_THAT(clean.words, HasSubstr("every sample (" + fitness + "): statistics would not be exact, least squared"));
    auto const robust = choose(fitness, 0.3, 90'900, "huber");
    EXPECT_FALSE(robust.from_statistics);
    EXPECT_THAT(robust.words, HasSubstr("huber is no sum of squares"));
  }
}

TEST(FitnessChoice, DoesWhatTheJobSays) {
  EXPECT_FALSE(choose("direct", 0.3, 90'900).from_statistics);
  EXPECT_FALSE(may_use_statistics({"squares", 0.0, "mse", "direct"}));
  EXPECT_FALSE(may_use_statistics({"huber", 0.0, "mse", "gram"}));
  EXPECT_TRUE(may_use_statistics({}));
  // no statistics are needed to decide that
  EXPECT_FALSE(choose_fitness({"squares", 0.0, "mse", "direct"}, nullptr, 90'900).from_statistics);
}

}  // namespace
}  // namespace torquescope
