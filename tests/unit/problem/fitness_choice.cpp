#include "engine/fit/problem/fitness_choice.hpp"

#include <gmock/gmock.h>

#include "unit/problem/joint_data.hpp"

namespace torquescope {
namespace fitness_choice_test {

using testing::HasSubstr;

FitnessChoice choose(std::string const& fitness, double noise, std::int64_t evaluations,
                     std::string const& loss = "squares") {
  auto const data = test::seed_data(10.0, noise);
  SufficientStatistics const statistics(data.phi, data.tau);
  return choose_fitness({loss, 0.0, "mse", fitness}, 4, evaluations, &statistics);
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
  EXPECT_FALSE(wants_statistics({"squares", 0.0, "mse", "direct"}, 4, 90'900));
  EXPECT_FALSE(wants_statistics({"huber", 0.0, "mse", "gram"}, 4, 90'900));
  EXPECT_TRUE(wants_statistics({}, 4, 90'900));
  // no statistics are needed to decide that
  EXPECT_FALSE(choose_fitness({"squares", 0.0, "mse", "direct"}, 4, 90'900, nullptr).from_statistics);
}

TEST(FitnessChoice, CountsEvaluationsBeforeStatisticsAreMade) {
  // two sweeps cost some 50 evaluations of four parameters: a search of ten is told so without them
  EXPECT_FALSE(wants_statistics({}, 4, 10));
  EXPECT_TRUE(wants_statistics({"squares", 0.0, "mse", "gram"}, 4, 10));
  auto const choice = choose_fitness({}, 4, 10, nullptr);
  EXPECT_FALSE(choice.from_statistics);
  EXPECT_THAT(choice.words, HasSubstr("10 evaluations do not repay statistics"));
}

}  // namespace fitness_choice_test
}  // namespace torquescope
