// What every optimiser of the registry promises, checked by name: a new choice is covered without a new test.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "engine/fit/optim/generational_search.hpp"
#include "engine/fit/optim/selection.hpp"
#include "support/optimise.hpp"

namespace torquescope {
namespace every_optimiser_test {

using testing::ask;
using testing::asked_and_evaluated;
using testing::make_optimiser;
using testing::run_to_generation;

Bounds const box{{-1.0, -2.0, 0.5}, {1.0, 3.0, 4.0}};
RandomKey const key{2024, 3};
constexpr double nan = std::numeric_limits<double>::quiet_NaN();

// the least value is at a corner of the box, so that many mutants leave it
double cornered(std::span<double const> x) { return (x[0] - 1.0) * (x[0] - 1.0) + std::fabs(x[1] + 2.0) + x[2] * x[2]; }

// no finite value in half of the box, its best corner included
double half_undefined(std::span<double const> x) {
  if (x[0] > 0.9) return -std::numeric_limits<double>::infinity();
  return x[1] < 0.5 ? nan : cornered(x);
}

bool same_bits(double a, double b) { return a == b || (std::isnan(a) && std::isnan(b)); }

bool same_bits(std::span<double const> a, std::span<double const> b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](double x, double y) { return same_bits(x, y); });
}

void expect_same_progress(Progress const& a, Progress const& b) {
  EXPECT_EQ(a.generation, b.generation);
  EXPECT_EQ(a.evaluations, b.evaluations);
  EXPECT_EQ(a.nonfinite, b.nonfinite);
  EXPECT_EQ(a.last_improvement, b.last_improvement);
  EXPECT_EQ(a.best_fitness, b.best_fitness);
  EXPECT_TRUE(same_bits(a.best, b.best));
  EXPECT_TRUE(same_bits(a.F, b.F) && same_bits(a.CR, b.CR) && same_bits(a.PC, b.PC) && same_bits(a.FC, b.FC));
}

void expect_same_search(Optimiser const& a, Optimiser const& b) {
  expect_same_progress(a.progress(), b.progress());
  EXPECT_EQ(ask(a).numbers, ask(b).numbers);
  EXPECT_TRUE(same_bits(a.fitness(), b.fitness()));
}

// those that keep members, and replace them one by one, promise more than those that sample anew
bool keeps_members(Optimiser const& search) { return dynamic_cast<GenerationalSearch const*>(&search) != nullptr; }

class EveryOptimiser : public ::testing::TestWithParam<std::string> {
 protected:
  std::unique_ptr<Optimiser> make(RandomKey of = key) const { return make_optimiser(GetParam(), box, of); }
};

TEST_P(EveryOptimiser, GivesTheSameBitsForTheSameKey) {
  auto const a = make();
  auto const b = make();
  run_to_generation(*a, cornered, 25);
  run_to_generation(*b, cornered, 25);
  expect_same_search(*a, *b);
}

TEST_P(EveryOptimiser, GivesOtherCandidatesForAnotherSeedOrRun) {
  auto const numbers = ask(*make()).numbers;
  EXPECT_NE(numbers, ask(*make({key.seed + 1, key.run})).numbers);
  EXPECT_NE(numbers, ask(*make({key.seed, key.run + 1})).numbers);
}

TEST_P(EveryOptimiser, AskingTwiceGivesTheSameRows) {
  auto const search = make();
  EXPECT_EQ(ask(*search).numbers, ask(*search).numbers);
  run_to_generation(*search, cornered, 3);
  EXPECT_EQ(ask(*search).numbers, ask(*search).numbers);
}

TEST_P(EveryOptimiser, BeginsWhereItIsToldAsFarAsThatIsKnown) {
  auto const search = make();
  auto elsewhere = ask(*search);
  search->start_at(std::vector<double>{0.25, nan, 99.0});
  auto told = ask(*search);
  if (!keeps_members(*search)) {  // a distribution: every candidate has moved, but along what is not known
    for (std::size_t i = 0; i < told.fitness.size(); ++i) {
      EXPECT_NE(told.rows()(i, 0), elsewhere.rows()(i, 0));
      EXPECT_EQ(told.rows()(i, 1), elsewhere.rows()(i, 1));
    }
    return;
  }
  auto expected = elsewhere.numbers;
  expected[0] = 0.25;
  expected[2] = box.upper[2];
  EXPECT_EQ(told.numbers, expected);
}

TEST_P(EveryOptimiser, KeepsEveryCandidateInsideTheBounds) {
  auto const search = make();
  for (int generation = 0; generation < 60; ++generation) {
    auto batch = asked_and_evaluated(*search, cornered);
    for (std::size_t i = 0; i < batch.fitness.size(); ++i) {
      for (std::size_t j = 0; j < box.dimension(); ++j) {
        ASSERT_GE(batch.rows()(i, j), box.lower[j]);
        ASSERT_LE(batch.rows()(i, j), box.upper[j]);
      }
    }
    search->tell(batch.rows(), batch.fitness);
  }
}

TEST_P(EveryOptimiser, Descends) {
  auto const search = make();
  double best = std::numeric_limits<double>::infinity();
  std::int64_t last_fall = 0;
  for (std::int64_t generation = 0; generation <= 60; ++generation) {
    run_to_generation(*search, cornered, generation);
    auto const& progress = search->progress();
    EXPECT_LE(progress.best_fitness, best);
    if (progress.best_fitness < best) last_fall = generation;
    EXPECT_EQ(progress.last_improvement, last_fall);
    EXPECT_EQ(progress.best_fitness, cornered(progress.best));
    best = progress.best_fitness;
  }
  EXPECT_LT(best - 0.25, 0.01);
}

TEST_P(EveryOptimiser, CountsAndNeverSelectsNonfiniteFitness) {
  auto const search = make();
  std::int64_t nonfinite = 0;
  std::int64_t evaluations = 0;
  for (int generation = 0; generation < 40; ++generation) {
    auto batch = asked_and_evaluated(*search, half_undefined);
    for (double const f : batch.fitness) nonfinite += std::isfinite(f) ? 0 : 1;
    evaluations += static_cast<std::int64_t>(batch.fitness.size());
    search->tell(batch.rows(), batch.fitness);
    EXPECT_EQ(search->progress().nonfinite, nonfinite);
    EXPECT_EQ(search->progress().evaluations, evaluations);
    EXPECT_TRUE(std::isfinite(search->progress().best_fitness));
    EXPECT_EQ(search->progress().best_fitness, half_undefined(search->progress().best));
    // the initial population has no movement; every later one has
    EXPECT_EQ(std::isnan(search->progress().FC), generation == 0 || !keeps_members(*search));
  }
  EXPECT_GT(nonfinite, 0);
  for (std::size_t i = 0; i < search->population().rows(); ++i) {
    EXPECT_EQ(search->fitness()[i], ranked_fitness(half_undefined(search->population().row(i))));
  }
  // in the end every slot has met a finite trial. JADE takes longest, up to 223 generations in forty runs: near the
  // edge of what is defined only small F succeed, and members far from it would need a large one
  run_to_generation(*search, half_undefined, 400);
  for (double const f : search->fitness()) EXPECT_TRUE(std::isfinite(f) || !keeps_members(*search));
}

TEST_P(EveryOptimiser, LivesThroughAnObjectiveThatIsNeverFinite) {
  auto const search = make();
  run_to_generation(
      *search, [](auto) { return nan; }, 10);
  auto const& progress = search->progress();
  EXPECT_EQ(progress.best_fitness, std::numeric_limits<double>::infinity());
  EXPECT_EQ(progress.nonfinite, progress.evaluations);
  for (double const x : progress.best) EXPECT_TRUE(std::isnan(x));
  // and finds its way when numbers come at last
  run_to_generation(*search, cornered, 40);
  EXPECT_TRUE(std::isfinite(search->progress().best_fitness));
}

TEST_P(EveryOptimiser, ContinuesFromCheckpointAsIfUninterrupted) {
  for (std::int64_t const stop_at : {-1, 0, 1, 2, 9}) {
    auto const whole = make();
    auto const first = make();
    if (stop_at >= 0) run_to_generation(*first, half_undefined, stop_at);
    auto const resumed = make();
    // into an object that has already been somewhere else
    run_to_generation(*resumed, cornered, 4);
    resumed->restore(first->save());
    expect_same_search(*resumed, *first);
    run_to_generation(*resumed, half_undefined, 30);
    run_to_generation(*whole, half_undefined, 30);
    expect_same_search(*resumed, *whole);
  }
}

TEST_P(EveryOptimiser, NeverHasMoreMembersThanItsLargestBatch) {
  auto const search = make();
  std::size_t const largest = search->largest_batch();
  EXPECT_EQ(search->batch_size(), largest);
  for (std::int64_t generation = 0; generation < 120; ++generation) {
    run_to_generation(*search, cornered, generation);
    ASSERT_EQ(search->largest_batch(), largest);
    ASSERT_LE(search->batch_size(), largest);
    ASSERT_EQ(search->population().rows(), search->batch_size());
    ASSERT_EQ(search->fitness().size(), search->batch_size());
  }
  // and the smaller one goes on from its state
  auto const resumed = make();
  resumed->restore(search->save());
  expect_same_search(*resumed, *search);
  EXPECT_EQ(resumed->largest_batch(), largest);
}

// a stretched one, and one at the end of a curved valley
TEST_P(EveryOptimiser, FindsASmoothMinimum) {
  Bounds const cube = testing::cube(4, -2.0, 3.0);
  auto const ellipsoid = [](std::span<double const> x) {
    double sum = 0.0;
    for (std::size_t j = 0; j < 4; ++j) sum += std::pow(10.0, static_cast<double>(j)) * (x[j] - 0.7) * (x[j] - 0.7);
    return sum;
  };
  auto const rosenbrock = [](std::span<double const> x) {
    double const valley = x[1] - x[0] * x[0];
    return 100.0 * valley * valley + (1.0 - x[0]) * (1.0 - x[0]) + x[2] * x[2] + x[3] * x[3];
  };
  std::vector<Setting> const thirty{{"population", std::int64_t{30}}};
  std::vector<double> ends;
  for (std::uint32_t run = 0; run < 5; ++run) {
    auto const on_ellipsoid = make_optimiser(GetParam(), cube, {1, run}, thirty);
    run_to_generation(*on_ellipsoid, ellipsoid, 200);
    EXPECT_LT(on_ellipsoid->progress().best_fitness, 1e-6);
    auto const on_rosenbrock = make_optimiser(GetParam(), cube, {1, run}, thirty);
    run_to_generation(*on_rosenbrock, rosenbrock, 400);
    ends.push_back(on_rosenbrock->progress().best_fitness);
  }
  std::sort(ends.begin(), ends.end());
  EXPECT_LT(ends[2], 1e-3);
}

// long enough that starts end and others begin; FADE as its paper prints it depends on the scale
TEST_P(EveryOptimiser, IgnoresScaleAndOffsetOfFitness) {
  std::vector<Setting> settings;
  if (GetParam() == "fade") settings.push_back({"norm", std::string("relative")});
  auto const after = [&](testing::Fitness const& fitness) {
    auto const search = make_optimiser(GetParam(), testing::cube(3, -2.0, 2.0), key, settings);
    run_to_generation(*search, fitness, 600);
    return ask(*search).numbers;
  };
  auto const reference = after(testing::bumpy);
  EXPECT_EQ(after([](auto x) { return 0x1p40 * testing::bumpy(x); }), reference);
  EXPECT_EQ(after([](auto x) { return 0x1p-300 * testing::bumpy(x); }), reference);
  EXPECT_EQ(after([](auto x) { return testing::bumpy(x) + 4096.0; }), reference);
}

TEST_P(EveryOptimiser, ScalesWithTheBox) {
  std::vector<Setting> settings;
  if (GetParam() == "fade") settings.push_back({"norm", std::string("relative")});
  auto const plain = make_optimiser(GetParam(), testing::cube(3, -2.0, 2.0), key, settings);
  auto const scaled = make_optimiser(GetParam(), testing::cube(3, -0x1p21, 0x1p21), key, settings);
  run_to_generation(*plain, testing::bumpy, 600);
  run_to_generation(
      *scaled,
      [](auto x) {
        return testing::bumpy(std::array{x[0] * 0x1p-20, x[1] * 0x1p-20, x[2] * 0x1p-20});
      },
      600);
  auto const expected = ask(*plain).numbers, numbers = ask(*scaled).numbers;
  for (std::size_t i = 0; i < numbers.size(); ++i) EXPECT_EQ(numbers[i], 0x1p20 * expected[i]);
}

TEST_P(EveryOptimiser, RefusesAStateOfAnotherKindSizeOrKey) {
  auto const search = make();
  run_to_generation(*search, cornered, 3);
  auto const before = ask(*search).numbers;
  auto const refuse = [&](OptimiserState const& state) {
    EXPECT_THROW(search->restore(state), std::invalid_argument);
    EXPECT_EQ(ask(*search).numbers, before);
  };
  refuse({});
  refuse(make({key.seed + 1, key.run})->save());
  refuse(make_optimiser(GetParam(), testing::cube(2, 0.0, 1.0), key)->save());
  for (auto const& choice : optimiser_choices()) {
    if (choice.name != GetParam()) refuse(make_optimiser(choice.name, box, key)->save());
  }
  // one entry missing
  auto const whole = search->save();
  for (auto const& [name, numbers] : whole) {
    auto state = whole;
    state.erase(name);
    refuse(state);
  }
}

TEST_P(EveryOptimiser, AcceptsATruncatedBatch) {
  auto const search = make();
  for (int generation = 0; generation < 3; ++generation) {
    auto batch = asked_and_evaluated(*search, cornered);
    std::size_t const rows = generation == 0 ? 3 : batch.fitness.size() / 2;
    std::vector<double> const old(search->fitness().begin(), search->fitness().end());
    auto const evaluations = search->progress().evaluations;
    search->tell(batch.rows().rows(0, rows), std::span(batch.fitness).first(rows));
    EXPECT_EQ(search->progress().evaluations, evaluations + static_cast<std::int64_t>(rows));
    EXPECT_EQ(search->progress().nonfinite, 0);
    for (std::size_t i = rows; i < old.size(); ++i) EXPECT_EQ(search->fitness()[i], old[i]);
  }
  EXPECT_EQ(search->progress().best_fitness, cornered(search->progress().best));
}

TEST_P(EveryOptimiser, HasNoControlsBeforeTheFirstGeneration) {
  auto const search = make();
  run_to_generation(*search, cornered, 0);
  auto const& progress = search->progress();
  for (double const number : {progress.F, progress.CR, progress.PC, progress.FC}) EXPECT_TRUE(std::isnan(number));
}

TEST_P(EveryOptimiser, DescribesItsOptionsAndRefusesWrongOnes) {
  auto const* choice = find_optimiser(GetParam());
  ASSERT_NE(choice, nullptr);
  EXPECT_EQ(choice->name, GetParam());
  EXPECT_FALSE(choice->options.empty());
  for (auto const& option : choice->options) EXPECT_FALSE(option.meaning.empty()) << option.key;

  std::vector<Problem> problems;
  auto const section = testing::estimator_section(
      {{"name", GetParam()}, {"populaton", std::int64_t{30}}, {"population", std::int64_t{3}}});
  choice->prepare(section, {"name"}, problems);
  ASSERT_EQ(problems.size(), 2u);
  EXPECT_EQ(problems[0].caret_note, "did you mean \"population\"?");
  EXPECT_EQ(problems[1].key, "estimator.population");
}

TEST_P(EveryOptimiser, SaysItsPopulationSizeBeforehand) {
  auto const* choice = find_optimiser(GetParam());
  EXPECT_EQ(choice->population_size(testing::estimator_section({}), 3), make()->batch_size());
  std::vector<Setting> const settings{{"population", std::int64_t{17}}};
  EXPECT_EQ(choice->population_size(testing::estimator_section(settings), 3),
            make_optimiser(GetParam(), box, key, settings)->batch_size());
}

std::vector<std::string> names() {
  std::vector<std::string> all;
  for (auto const& choice : optimiser_choices()) all.push_back(choice.name);
  return all;
}

INSTANTIATE_TEST_SUITE_P(Registry, EveryOptimiser, ::testing::ValuesIn(names()),
                         [](auto const& of) { return of.param; });

TEST(OptimiserRegistry, FindsByNameOnly) {
  EXPECT_GE(optimiser_choices().size(), 2u);
  EXPECT_EQ(find_optimiser("no such thing"), nullptr);
}

}  // namespace every_optimiser_test
}  // namespace torquescope
