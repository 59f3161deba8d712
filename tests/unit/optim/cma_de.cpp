#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <tuple>

#include "support/landscapes.hpp"

namespace torquescope {
namespace cma_de_test {

using testing::ask;
using testing::bumpy;
using testing::make_optimiser;
using testing::run_to_generation;

Bounds const box = testing::cube(3, -2.0, 2.0);
RandomKey const key{5, 1};

std::unique_ptr<Optimiser> make(std::vector<Setting> settings = {}) {
  return make_optimiser("cma_de", box, key, std::move(settings));
}

bool is_history_next(Optimiser const& search) { return search.save().at("turns")[0] != 0.0; }
double samples(OptimiserState const& state, std::string const& kind) { return state.at(kind + " starts")[0]; }

TEST(CmaDe, TwoDistributionsComeFirstThenBothKindsInTurn) {
  auto const search = make();
  std::int64_t of_history = 0, of_covariance = 0;
  for (std::int64_t generation = 0; generation < 1500; ++generation) {
    bool const is_history = is_history_next(*search);
    bool const may_be = samples(search->save(), "covariance") >= 4.0;
    ASSERT_TRUE(may_be || !is_history);
    run_to_generation(*search, bumpy, generation);
    // controls are those of trials
    if (std::isfinite(search->progress().F)) {
      ASSERT_TRUE(is_history);
    }
    if (may_be) ++(is_history ? of_history : of_covariance);
  }
  EXPECT_GT(of_history, 100);
  EXPECT_GT(of_covariance, 100);
}

// owed evaluations never grow beyond what one sweep or one generation of a distribution holds back
TEST(CmaDe, KeepsToTheShareThatMovementDeserves) {
  for (std::string const sharing : {"fuzzy", "even"}) {
    auto const search = make({{"sharing", sharing}});
    double least = 1.0, most = 0.0;
    for (std::int64_t generation = 0; generation < 1500; ++generation) {
      run_to_generation(*search, bumpy, generation);
      auto const state = search->save();
      double const longest = std::max(static_cast<double>(state.at("members fitness").size()),
                                      samples(state, "covariance") * static_cast<double>(search->batch_size()));
      ASSERT_LE(std::fabs(state.at("turns")[2]), longest);
      least = std::min(least, state.at("turns")[1]);
      most = std::max(most, state.at("turns")[1]);
    }
    EXPECT_EQ(least < most, sharing == "fuzzy");
    EXPECT_GE(least, 0.1);
    EXPECT_LE(most, 0.9);
  }
}

// before and in both kinds of start
TEST(CmaDe, GoesOnFromTheMiddleOfEveryKindOfStart) {
  auto const whole = make();
  auto resumed = make();
  bool was_filling = false, was_in_sweep = false, was_in_generation = false, had_doubled = false;
  for (std::int64_t generation = 0; generation <= 2500; ++generation) {
    run_to_generation(*whole, bumpy, generation);
    run_to_generation(*resumed, bumpy, generation);
    ASSERT_EQ(ask(*resumed).numbers, ask(*whole).numbers) << generation;
    if (generation % 7 != 0) continue;
    auto const state = resumed->save();
    auto const& places = state.at("members, next");
    was_filling |= places[0] > 0.0 && places[0] < static_cast<double>(state.at("members fitness").size());
    was_in_sweep |= places[1] > 0.0;
    was_in_generation |= !state.at("told").empty();
    had_doubled |= samples(state, "history") > 1.0;
    resumed = make();
    resumed->restore(state);
    ASSERT_EQ(resumed->save().at("members before"), state.at("members before"));
  }
  EXPECT_TRUE(was_filling && was_in_sweep && was_in_generation && had_doubled);
}

TEST(CmaDe, RefusesAStateThatItCannotBeIn) {
  auto const search = make({{"starts", std::string("history")}});
  run_to_generation(*search, bumpy, 40);
  auto const whole = search->save();
  for (auto const& [name, place, value] : {std::tuple{"members, next", 0, 3.0},
                                           {"members, next", 1, 1e6},
                                           {"covariance starts", 0, 0.5},
                                           {"sweeps", 0, 1e3}}) {
    auto state = whole;
    state.at(name)[static_cast<std::size_t>(place)] = value;
    EXPECT_THROW(search->restore(state), std::invalid_argument) << name;
    EXPECT_EQ(search->save().at("members"), whole.at("members"));
  }
}

// each kind of start has its landscape, and both together have both
TEST(CmaDe, SolvesWhatEitherKindSolvesAlone) {
  auto const solved = [](std::string const& landscape, std::string const& starts) {
    int n = 0;
    for (std::uint32_t run = 0; run < 5; ++run) {
      auto const search = make_optimiser("cma_de", testing::cube(5, -5.0, 5.0), {46, run}, {{"starts", starts}});
      n += testing::evaluations_to_target(*search, testing::Landscape(landscape, 5, run), 1e-6, 15000) > 0 ? 1 : 0;
    }
    return n;
  };
  for (std::string const landscape : {"ellipsoid", "rastrigin"}) EXPECT_GE(solved(landscape, "both"), 4) << landscape;
  EXPECT_EQ(solved("ellipsoid", "covariance"), 5);
  EXPECT_EQ(solved("rastrigin", "history"), 5);
}

// members of a differential evolution begin there too
TEST(CmaDe, HistoryBeginsWhereItIsTold) {
  auto const search = make({{"starts", std::string("history")}});
  auto expected = ask(*search).numbers;
  search->start_at(std::vector{0.25, std::numeric_limits<double>::quiet_NaN(), 99.0});
  expected[0] = 0.25;
  expected[2] = 2.0;
  EXPECT_EQ(ask(*search).numbers, expected);
}

TEST(CmaDe, EachOptionChangesTheSearch) {
  auto const asked_after = [](std::vector<Setting> settings) {
    auto const search = make(std::move(settings));
    run_to_generation(
        *search, [](auto x) { return bumpy(x) - x[0]; }, 900);
    return ask(*search).numbers;
  };
  auto const reference = asked_after({});
  std::vector<Setting> const settings{{"population", std::int64_t{12}},
                                      {"members", std::int64_t{60}},
                                      {"sigma", 0.1},
                                      {"best_share", 0.5},
                                      {"starts", std::string("history")},
                                      {"sharing", std::string("even")},
                                      {"teaching", std::string("better_half")},
                                      {"repair", std::string("reflect")}};
  for (auto const& setting : settings) EXPECT_NE(asked_after({setting}), reference) << setting.key;
}

}  // namespace cma_de_test
}  // namespace torquescope
