#include "engine/run/optimise.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <limits>

#include "engine/base/error.hpp"

namespace torquescope {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

// (x - 0.3)^2 summed over three parameters; infinite where the first one is above 0.9
class Bowl final : public Objective {
 public:
  Bounds const& bounds() const override { return bounds_; }
  void evaluate(MatrixView<double const> candidates, std::span<double> fitness, Workspace&) const override {
    for (std::size_t i = 0; i < candidates.rows(); ++i) {
      fitness[i] = 0.0;
      for (double x : candidates.row(i)) fitness[i] += (x - 0.3) * (x - 0.3);
      if (candidates(i, 0) > 0.9) fitness[i] = infinity;
    }
  }

 private:
  Bounds bounds_{{-1, -1, -1}, {1, 1, 1}};
};

std::unique_ptr<Optimiser> make_fade(std::uint32_t run) {
  std::vector<Problem> problems;
  auto const make = find_optimiser("fade")->prepare(Section{}, {}, problems);
  return make(Bowl().bounds(), RandomKey{5, run});
}

RunHistory run_bowl(StopRules const& rules, int team, std::function<bool()> stop = {}) {
  Bowl const bowl;
  SearchSetting const setting{bowl, rules, 1.0, [](std::span<double const> x) { return x[0]; }, {}, std::move(stop)};
  auto const optimiser = make_fade(0);
  std::vector<Workspace> workspaces;
  return optimise(*optimiser, setting, team, workspaces);
}

TEST(Optimise, RecordsEveryGenerationAndStopsWhereAsked) {
  StopRules rules;
  rules.generations = 40;
  RunHistory const history = run_bowl(rules, 1);
  ASSERT_EQ(history.best.size(), 41u);
  EXPECT_EQ(history.stop_reason, "generations");
  EXPECT_EQ(history.evaluations.front(), 30);
  EXPECT_EQ(history.evaluations.back(), 41 * 30);
  EXPECT_GT(history.nonfinite, 0);
  for (std::size_t g = 1; g < history.best.size(); ++g) EXPECT_LE(history.best[g], history.best[g - 1]);
  EXPECT_LT(history.best.back(), 1e-4);
  // the last population's best member is the answer
  double best = infinity;
  for (std::size_t i = 0; i < 30; ++i) best = std::min(best, history.fitness[40 * 30 + i]);
  EXPECT_EQ(best, history.best.back());
}

TEST(Optimise, GivesTheSameBitsForEveryTeam) {
  StopRules rules;
  rules.generations = 15;
  RunHistory const alone = run_bowl(rules, 1);
  for (int team : {2, 3}) {
    RunHistory const together = run_bowl(rules, team);
    EXPECT_EQ(alone.population, together.population);
    EXPECT_EQ(alone.best, together.best);
  }
}

TEST(Optimise, SpendsAnEvaluationBudgetExactly) {
  StopRules rules;
  rules.generations = 100;
  rules.evaluations = 137;
  RunHistory const history = run_bowl(rules, 1);
  EXPECT_EQ(history.evaluations.back(), 137);
  EXPECT_EQ(history.stop_reason, "evaluations");
  EXPECT_TRUE(std::isnan(history.best.back()));  // generations that never were
}

TEST(Optimise, StopsAtOnceWhenAsked) {
  std::atomic<int> generations{0};
  StopRules rules;
  rules.generations = 1000;
  try {
    run_bowl(rules, 1, [&] { return ++generations > 3; });
    FAIL();
  } catch (Error const& error) {
    EXPECT_EQ(error.code(), ExitCode::stopped);
  }
  EXPECT_EQ(generations.load(), 4);
}

}  // namespace
}  // namespace torquescope
