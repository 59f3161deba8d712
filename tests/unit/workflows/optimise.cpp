#include "engine/experiment/runs/optimise.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <cstring>
#include <limits>
#include <set>
#include <stdexcept>

#include "engine/base/error.hpp"
#include "engine/fit/optim/generational_search.hpp"
#include "engine/fit/optim/optimiser_state.hpp"

namespace torquescope {
namespace optimise_test {

constexpr double infinity = std::numeric_limits<double>::infinity();

// (x - 0.3)^2 summed over three parameters; infinite where the first one is above 0.9
class Bowl final : public Objective {
 public:
  explicit Bowl(std::size_t bytes = 0) : bytes_(bytes) {}
  std::size_t bytes_swept() const override { return bytes_; }
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
  std::size_t bytes_;
};

std::unique_ptr<Optimiser> make_search(std::string const& name, std::uint32_t run) {
  std::vector<Problem> problems;
  auto const make = find_optimiser(name)->prepare(Section{}, {}, problems);
  return make(Bowl().bounds(), RandomKey{5, run});
}

std::unique_ptr<Optimiser> make_fade(std::uint32_t run) { return make_search("fade", run); }

// runs first, first + 1, ... of one study, side by side
std::vector<RunHistory> run_bowls(StopRules const& rules, std::uint32_t first, std::uint32_t count, int team = 1,
                                  std::function<bool()> stop = {}, std::string const& name = "fade") {
  Bowl const bowl;
  SearchSetting const setting{bowl, rules, 1.0, [](std::span<double const> x) { return x[0]; }, {}, std::move(stop)};
  std::vector<RunStart> starts;
  for (std::uint32_t run = first; run < first + count; ++run) starts.push_back({make_search(name, run)});
  std::vector<Workspace> workspaces;
  return optimise(std::move(starts), setting, team, workspaces);
}

RunHistory run_bowl(StopRules const& rules, int team, std::function<bool()> stop = {}) {
  return run_bowls(rules, 0, 1, team, std::move(stop)).front();
}

void expect_same_bits(RunHistory const& a, RunHistory const& b) {
  auto const same = [](std::vector<double> const& x, std::vector<double> const& y) {
    return x.size() == y.size() && std::memcmp(x.data(), y.data(), x.size() * sizeof(double)) == 0;
  };
  for (auto const list :
       {&RunHistory::population, &RunHistory::fitness, &RunHistory::F, &RunHistory::CR, &RunHistory::PC,
        &RunHistory::FC, &RunHistory::best, &RunHistory::gap, &RunHistory::parameters})
    EXPECT_TRUE(same(a.*list, b.*list));
  EXPECT_EQ(a.evaluations, b.evaluations);
  EXPECT_EQ(a.stop_reason, b.stop_reason);
  EXPECT_EQ(a.nonfinite, b.nonfinite);
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

TEST(Optimise, ARunHasTheSameBitsAloneAndBesideOthers) {
  StopRules rules;
  rules.generations = 60;
  rules.target = 2e-4;  // reached by every run in a generation of its own
  rules.evaluations = 1234;
  std::set<std::int64_t> ends;
  for (std::uint32_t const count : {2u, 3u, 5u}) {
    auto const together = run_bowls(rules, 0, count);
    ASSERT_EQ(together.size(), count);
    for (std::uint32_t run = 0; run < count; ++run) {
      expect_same_bits(together[run], run_bowls(rules, run, 1).front());
      ends.insert(together[run].evaluations.back());
    }
  }
  EXPECT_GT(ends.size(), 2u);
}

TEST(Optimise, RunsSideBySideSpendTheirOwnBudgets) {
  StopRules rules;
  rules.generations = 100;
  rules.evaluations = 137;
  for (auto const& history : run_bowls(rules, 0, 3)) {
    EXPECT_EQ(history.evaluations.back(), 137);
    EXPECT_EQ(history.stop_reason, "evaluations");
  }
}

// makes an initial population and no trial
class Broken final : public GenerationalSearch {
 public:
  Broken() : GenerationalSearch("broken", Bowl().bounds(), {5, 9}, 30) {}

 private:
  void make_trials(TrialStreams const&, MatrixView<double> const&) const override {
    throw std::runtime_error("broken");
  }
  void learn(Selected const&, Progress&) override {}
};

TEST(Optimise, AnExceptionOfOneRunIsToldNotSwallowed) {
  Bowl const bowl;
  StopRules const rules;
  SearchSetting const setting{bowl, rules, 1.0, [](std::span<double const> x) { return x[0]; }};
  std::vector<RunStart> starts;
  starts.push_back({make_fade(0)});
  starts.push_back({std::make_unique<Broken>()});
  std::vector<Workspace> workspaces;
  EXPECT_THROW(optimise(std::move(starts), setting, 1, workspaces), std::runtime_error);
}

TEST(Optimise, GoesSideBySideOnlyWhereTheRecordingIsReadAnewAndNoRuleCountsSeconds) {
  Bowl const small(100'000), large(50'000'000);
  StopRules rules;
  EXPECT_EQ(runs_side_by_side(small, rules, 30), 1u);
  EXPECT_EQ(runs_side_by_side(large, rules, 30), 4u);
  EXPECT_EQ(runs_side_by_side(large, rules, 100), 1u);
  EXPECT_EQ(runs_side_by_side(large, rules, 1000), 1u);
  rules.wall_clock_s = 5.0;
  EXPECT_EQ(runs_side_by_side(large, rules, 30), 1u);
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

// asked after the last generation too: with 137 evaluations the fifth of thirty candidates is cut
TEST(Optimise, KeepsNothingOfABatchThatABudgetCut) {
  Bowl const bowl;
  for (std::int64_t const evaluations : {137, 120, 20}) {
    StopRules rules;
    rules.generations = 100;
    rules.evaluations = evaluations;
    SearchSetting setting{bowl, rules, 1.0, [](std::span<double const> x) { return x[0]; }, {}};
    setting.keep_now = [] { return true; };
    std::size_t generations = 99;
    OptimiserState last;
    setting.keep = [&](std::size_t, RunSoFar const& so_far) {
      generations = so_far.generations;
      last = so_far.state();
    };
    std::vector<RunStart> starts;
    starts.push_back({make_fade(0)});
    std::vector<Workspace> workspaces;
    RunHistory const history = optimise(std::move(starts), setting, 1, workspaces).front();
    EXPECT_EQ(generations, static_cast<std::size_t>(evaluations) / 30);
    EXPECT_EQ(history.told, (static_cast<std::size_t>(evaluations) + 29) / 30);
    EXPECT_EQ(history.last_state, without_population(last));
    ASSERT_EQ(last.empty(), evaluations < 30);
    if (last.empty()) continue;
    EXPECT_EQ(generation_of(last) + 1, static_cast<std::int64_t>(generations));
    auto const members = std::span<double const>(history.population).subspan((generations - 1) * 90, 90);
    auto const fitness = std::span<double const>(history.fitness).subspan((generations - 1) * 30, 30);
    EXPECT_EQ(with_population(history.last_state, members, fitness), last);
  }
}

// of one kind of optimiser
void expect_same_bits_when_interrupted(std::string const& name) {
  Bowl const bowl;
  StopRules rules;
  rules.generations = 60;
  rules.target = 2e-4;  // runs end before, each in a generation of its own
  rules.evaluations = 1234;
  auto const whole = run_bowls(rules, 0, 3, 1, {}, name);
  for (int const interval : {1, 2, 7, 30}) {
    // every `interval` generations all runs are stopped, and begun anew from what was kept of them
    std::vector<RunStart> starts;
    for (std::uint32_t run = 0; run < 3; ++run) starts.push_back({make_search(name, run)});
    std::vector<RunHistory> resumed;
    for (int attempts = 0; resumed.empty() && attempts < 100; ++attempts) {
      std::vector<RunStart> kept(3);
      int polls = 0;
      SearchSetting setting{bowl, rules, 1.0, [](std::span<double const> x) { return x[0]; }, {}};
      setting.stop_requested = [&] { return polls++ == interval; };
      setting.keep = [&](std::size_t index, RunSoFar const& so_far) {
        kept[index] = {make_search(name, static_cast<std::uint32_t>(index)), so_far.history};
        kept[index].search->restore(so_far.state());
      };
      std::vector<Workspace> workspaces;
      try {
        resumed = optimise(std::move(starts), setting, 1, workspaces);
      } catch (Error const& error) {
        EXPECT_EQ(error.code(), ExitCode::stopped);
      }
      starts = std::move(kept);
    }
    ASSERT_EQ(resumed.size(), 3u) << name << ", " << interval;
    for (std::size_t run = 0; run < 3; ++run) {
      expect_same_bits(resumed[run], whole[run]);
      EXPECT_EQ(resumed[run].told, whole[run].told);
    }
  }
}

TEST(Optimise, InterruptedAnywhereGoesOnToTheSameBits) {
  for (auto const& choice : optimiser_choices()) expect_same_bits_when_interrupted(choice.name);
}

TEST(Optimise, StoresAShrinkingPopulationAtItsFirstSize) {
  StopRules rules;
  rules.generations = 100;
  RunHistory const history = run_bowls(rules, 0, 1, 1, {}, "lshade").front();
  ASSERT_EQ(history.fitness.size(), 101u * 54u);
  ASSERT_EQ(history.population.size(), 101u * 54u * 3u);
  std::size_t before = 54;
  for (std::size_t g = 0; g <= 100; ++g) {
    // the members that are left stand first
    std::size_t members = 0;
    while (members < 54 && !std::isnan(history.fitness[g * 54 + members])) ++members;
    EXPECT_LE(members, before);
    for (std::size_t i = 0; i < 54; ++i) {
      EXPECT_EQ(std::isnan(history.fitness[g * 54 + i]), i >= members);
      for (std::size_t j = 0; j < 3; ++j) EXPECT_EQ(std::isnan(history.population[(g * 54 + i) * 3 + j]), i >= members);
    }
    std::int64_t const evaluations_before = g > 0 ? history.evaluations[g - 1] : 0;
    EXPECT_EQ(history.evaluations[g], evaluations_before + static_cast<std::int64_t>(before));
    before = members;
  }
  EXPECT_EQ(before, 4u);
}

TEST(Optimise, KeepsEveryRunWhenAsked) {
  Bowl const bowl;
  StopRules rules;
  rules.generations = 10;
  std::vector<std::size_t> generations;
  SearchSetting setting{bowl, rules, 1.0, [](std::span<double const> x) { return x[0]; }, {}};
  setting.keep_now = [asked = 0]() mutable { return ++asked == 4; };
  setting.keep = [&](std::size_t, RunSoFar const& so_far) { generations.push_back(so_far.generations); };
  std::vector<RunStart> starts;
  starts.push_back({make_fade(0)});
  starts.push_back({make_fade(1)});
  std::vector<Workspace> workspaces;
  EXPECT_EQ(optimise(std::move(starts), setting, 1, workspaces).front().told, 11u);
  EXPECT_EQ(generations, (std::vector<std::size_t>{4, 4}));
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

}  // namespace optimise_test
}  // namespace torquescope
