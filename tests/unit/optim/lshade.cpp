#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/fit/optim/success_history.hpp"
#include "support/current_to_pbest.hpp"

namespace torquescope {
namespace lshade_test {

using testing::ask;
using testing::bumpy;
using testing::make_optimiser;
using testing::members_of;
using testing::run_to_generation;

Bounds const box = testing::cube(3, -2.0, 2.0);
RandomKey const key{5, 1};

// two generations written out plainly: what is asked, who is replaced, what the memory and the archive hold then
TEST(Lshade, TakesTheStepsOfThePaper) {
  constexpr std::size_t N = 8, D = 3, H = 6;
  auto const search =
      make_optimiser("lshade", box, key, {{"population", std::int64_t{N}}, {"reduction", std::string("none")}});
  run_to_generation(*search, bumpy, 0);
  std::vector<double> M_F(H, 0.5), M_CR(H, 0.5);
  std::vector<std::vector<double>> archive;
  std::size_t k = 0, n_successes = 0;
  for (std::uint32_t generation = 1; generation <= 3; ++generation) {
    auto const before = testing::plain_population(*search);
    auto const& x = before.x;
    auto const& f = before.f;

    auto batch = ask(*search);
    std::vector<double> S_F, S_CR, gain;
    std::vector<std::vector<double>> replaced;
    for (std::size_t i = 0; i < N; ++i) {
      RandomStream random(key, generation, static_cast<std::uint32_t>(i));
      std::size_t const r = random.below(H);
      auto const [F, CR, u] = testing::plain_trial(before, archive, M_F[r], M_CR[r], i, random);
      for (std::size_t j = 0; j < D; ++j) EXPECT_NEAR(batch.rows()(i, j), u[j], 1e-15) << generation << ", " << i;
      batch.fitness[i] = bumpy(batch.rows().row(i));
      if (batch.fitness[i] >= f[i]) continue;
      S_F.push_back(F);
      S_CR.push_back(CR);
      gain.push_back(f[i] - batch.fitness[i]);
      replaced.push_back(x[i]);
    }
    archive.insert(archive.end(), replaced.begin(), replaced.end());
    ASSERT_LE(archive.size(), 20u) << "2.6 x 8: nobody leaves in this test";
    search->tell(batch.rows(), batch.fitness);
    if (!gain.empty()) {
      double F2 = 0.0, F1 = 0.0, CR2 = 0.0, CR1 = 0.0;
      for (std::size_t s = 0; s < gain.size(); ++s) {
        F2 += gain[s] * S_F[s] * S_F[s];
        F1 += gain[s] * S_F[s];
        CR2 += gain[s] * S_CR[s] * S_CR[s];
        CR1 += gain[s] * S_CR[s];
      }
      M_F[k] = F2 / F1;
      M_CR[k] = CR2 / CR1;
      k = (k + 1) % H;
    }
    n_successes += gain.size();
    auto const state = search->save();
    auto const& history = state.at("history");
    for (std::size_t h = 0; h < H; ++h) {
      EXPECT_NEAR(history[h], M_F[h], 1e-14);
      EXPECT_NEAR(history[H + h], M_CR[h], 1e-14);
      // the same numbers from here on, not only nearly
      M_F[h] = history[h];
      M_CR[h] = history[H + h];
    }
    std::vector<double> rows;
    for (auto const& row : archive) rows.insert(rows.end(), row.begin(), row.end());
    EXPECT_EQ(state.at("archive"), rows);
  }
  EXPECT_GT(n_successes, 5u);
}

TEST(Lshade, PopulationShrinksLinearlyToFourAndTheBestStay) {
  for (std::string const budget : {"evaluations", "generations"}) {
    std::int64_t const limit = budget == "evaluations" ? 2000 : 60;
    auto const search = make_optimiser("lshade", box, key,
                                       {{"population", std::int64_t{40}},
                                        {budget, limit},
                                        {budget == "evaluations" ? "generations" : "evaluations", std::int64_t{0}}});
    EXPECT_EQ(search->batch_size(), 40u);
    auto const spent = [&] {
      return budget == "evaluations" ? search->progress().evaluations : search->progress().generation;
    };
    run_to_generation(*search, bumpy, 0);
    while (spent() < limit) {
      auto batch = testing::asked_and_evaluated(*search, bumpy);
      std::vector<double> left;
      for (std::size_t i = 0; i < batch.fitness.size(); ++i)
        left.push_back(std::min(batch.fitness[i], search->fitness()[i]));
      search->tell(batch.rows(), batch.fitness);
      double const share = std::min(1.0, static_cast<double>(spent()) / static_cast<double>(limit));
      ASSERT_EQ(search->batch_size(), static_cast<std::size_t>(std::lround(40.0 - 36.0 * share)));
      std::sort(left.begin(), left.end());
      left.resize(search->batch_size());
      std::vector<double> kept(search->fitness().begin(), search->fitness().end());
      std::sort(kept.begin(), kept.end());
      ASSERT_EQ(kept, left);
      // the archive shrinks with the population
      ASSERT_LE(search->save().at("archive").size() / 3,
                static_cast<std::size_t>(std::lround(2.6 * static_cast<double>(search->batch_size()))));
    }
    EXPECT_EQ(search->batch_size(), 4u);
  }
}

// room made by a member that had no number teaches nothing
TEST(Lshade, LearnsOnlyFromImprovementsThatCanBeMeasured) {
  auto const search = make_optimiser("lshade", box, key);
  run_to_generation(
      *search, [](auto) { return std::numeric_limits<double>::quiet_NaN(); }, 0);
  run_to_generation(*search, bumpy, 1);
  EXPECT_TRUE(std::isfinite(search->progress().best_fitness));
  EXPECT_EQ(search->save().at("history"), SuccessHistory(6).numbers());
  EXPECT_TRUE(search->save().at("archive").empty());
}

TEST(Lshade, EachOptionChangesTheSearch) {
  auto const best_after = [](std::vector<Setting> settings) {
    auto const search = make_optimiser("lshade", box, key, std::move(settings));
    run_to_generation(*search, bumpy, 40);
    return search->progress().best;
  };
  auto const reference = best_after({});
  std::vector<Setting> const settings{{"population", std::int64_t{12}},
                                      {"memory", std::int64_t{2}},
                                      {"best_share", 0.5},
                                      {"archive_share", 0.0},
                                      {"reduction", std::string("none")},
                                      {"repair", std::string("reflect")},
                                      {"evaluations", std::int64_t{2000}}};
  for (auto const& setting : settings) EXPECT_NE(best_after({setting}), reference) << setting.key;
}

}  // namespace lshade_test
}  // namespace torquescope
