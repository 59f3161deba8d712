#include <gtest/gtest.h>

#include <limits>

#include "support/current_to_pbest.hpp"

namespace torquescope {
namespace jade_test {

using testing::ask;
using testing::bumpy;
using testing::make_optimiser;
using testing::members_of;
using testing::run_to_generation;

Bounds const box = testing::cube(3, -2.0, 2.0);
RandomKey const key{5, 1};

std::string const means = "means of F, CR";

// generations written out plainly: what is asked, who enters and leaves the archive, where the means go
TEST(Jade, TakesTheStepsOfThePaper) {
  constexpr std::size_t N = 8;
  auto const search = make_optimiser("jade", box, key, {{"population", std::int64_t{N}}});
  run_to_generation(*search, bumpy, 0);
  double mu_F = 0.5, mu_CR = 0.5;
  std::vector<std::vector<double>> archive;
  std::size_t n_successes = 0, n_removed = 0;
  for (std::uint32_t generation = 1; generation <= 8; ++generation) {
    auto const before = testing::plain_population(*search);
    auto const& x = before.x;
    auto const& f = before.f;

    auto batch = ask(*search);
    double F2 = 0.0, F1 = 0.0, CR1 = 0.0, n = 0.0;
    auto grown = archive;
    for (std::size_t i = 0; i < N; ++i) {
      RandomStream random(key, generation, static_cast<std::uint32_t>(i));
      auto const trial = testing::plain_trial(before, archive, mu_F, mu_CR, i, random);
      for (std::size_t j = 0; j < 3; ++j) EXPECT_NEAR(batch.rows()(i, j), trial.u[j], 1e-15) << generation << ", " << i;
      batch.fitness[i] = bumpy(batch.rows().row(i));
      if (batch.fitness[i] >= f[i]) continue;
      F2 += trial.F * trial.F;
      F1 += trial.F;
      CR1 += trial.CR;
      n += 1.0;
      grown.push_back(x[i]);
    }
    search->tell(batch.rows(), batch.fitness);
    archive = grown;
    RandomStream random(key, generation, std::numeric_limits<std::uint32_t>::max());
    for (; archive.size() > N; ++n_removed) {
      archive[random.below(static_cast<std::uint32_t>(archive.size()))] = archive.back();
      archive.pop_back();
    }
    n_successes += static_cast<std::size_t>(n);
    if (n > 0.0) {
      mu_F = 0.9 * mu_F + 0.1 * F2 / F1;
      mu_CR = 0.9 * mu_CR + 0.1 * CR1 / n;
    }
    auto const state = search->save();
    EXPECT_NEAR(state.at(means)[0], mu_F, 1e-15);
    EXPECT_NEAR(state.at(means)[1], mu_CR, 1e-15);
    // the same numbers from here on, not only nearly
    mu_F = state.at(means)[0];
    mu_CR = state.at(means)[1];
    std::vector<double> rows;
    for (auto const& row : archive) rows.insert(rows.end(), row.begin(), row.end());
    EXPECT_EQ(state.at("archive"), rows);
  }
  EXPECT_GT(n_successes, 10u);
  EXPECT_GT(n_removed, 2u);
}

// neither a tie nor room made by a member that had no number is a success
TEST(Jade, LearnsOnlyFromImprovementsThatCanBeMeasured) {
  for (double const first : {std::numeric_limits<double>::quiet_NaN(), 1.0}) {
    auto const search = make_optimiser("jade", box, key);
    run_to_generation(
        *search, [&](auto) { return first; }, 0);
    auto const before = members_of(*search);
    run_to_generation(
        *search, [](auto) { return 1.0; }, 1);
    EXPECT_NE(members_of(*search), before);
    EXPECT_EQ(search->save().at(means), (std::vector{0.5, 0.5}));
    EXPECT_TRUE(search->save().at("archive").empty());
  }
}

TEST(Jade, TakesAsManyMembersAsThePaper) {
  for (auto const& [dimension, members] : {std::pair{10, 30}, {11, 100}, {30, 100}, {31, 400}, {100, 400}}) {
    auto const bounds = testing::cube(static_cast<std::size_t>(dimension), -1.0, 1.0);
    EXPECT_EQ(make_optimiser("jade", bounds, key)->batch_size(), static_cast<std::size_t>(members));
  }
}

TEST(Jade, EachOptionChangesTheSearch) {
  auto const best_after = [](std::vector<Setting> settings) {
    auto const search = make_optimiser("jade", box, key, std::move(settings));
    run_to_generation(*search, bumpy, 30);
    return search->progress().best;
  };
  auto const reference = best_after({});
  std::vector<Setting> const settings{{"population", std::int64_t{12}},
                                      {"best_share", 0.5},
                                      {"learning_rate", 0.5},
                                      {"archive_share", 0.0},
                                      {"repair", std::string("reflect")}};
  for (auto const& setting : settings) EXPECT_NE(best_after({setting}), reference) << setting.key;
}

}  // namespace jade_test
}  // namespace torquescope
