#pragma once
// Trials of JADE and L-SHADE in a box of -2 .. 2, written out as their papers do and apart from the engine's code.
//
// Equation   JADE's eq. 7, 8, 10, 12; the best two members lead, the least there are
// Source     Zhang, Sanderson: JADE, IEEE TEC 13 (2009), doi:10.1109/TEVC.2009.2014613

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include "support/optimise.hpp"

namespace torquescope::testing {

struct PlainPopulation {
  std::vector<std::vector<double>> x;
  std::vector<double> f;
  std::vector<std::size_t> order;  // from the best
};

inline PlainPopulation plain_population(Optimiser const& search) {
  PlainPopulation plain{{}, {search.fitness().begin(), search.fitness().end()}, {}};
  for (std::size_t i = 0; i < plain.f.size(); ++i) {
    auto const row = search.population().row(i);
    plain.x.emplace_back(row.begin(), row.end());
  }
  plain.order.resize(plain.f.size());
  std::iota(plain.order.begin(), plain.order.end(), std::size_t{0});
  std::stable_sort(plain.order.begin(), plain.order.end(), [&](auto a, auto b) { return plain.f[a] < plain.f[b]; });
  return plain;
}

struct PlainTrial {
  double F, CR;
  std::vector<double> u;
};

inline PlainTrial plain_trial(PlainPopulation const& of, std::vector<std::vector<double>> const& archive, double mu_F,
                              double mu_CR, std::size_t i, RandomStream& random) {
  std::size_t const N = of.x.size(), D = of.x[0].size();
  auto const& x = of.x;
  PlainTrial trial{0.0, std::clamp(mu_CR + 0.1 * random.normal(), 0.0, 1.0), x[i]};
  while (trial.F <= 0.0)
    trial.F = std::min(1.0, mu_F + 0.1 * std::tan(std::acos(-1.0) * (RandomStream::probability(random.bits()) - 0.5)));
  auto const& best = x[of.order[random.below(2)]];
  std::size_t r1 = random.below(static_cast<std::uint32_t>(N - 1));
  if (r1 >= i) ++r1;
  std::size_t r2 = random.below(static_cast<std::uint32_t>(N + archive.size() - 2));
  if (r2 >= std::min(i, r1)) ++r2;
  if (r2 >= std::max(i, r1)) ++r2;
  auto const& other = r2 < N ? x[r2] : archive[r2 - N];
  std::size_t const j_rand = random.below(static_cast<std::uint32_t>(D));
  for (std::size_t j = 0; j < D; ++j) {
    if (random.uniform() >= trial.CR && j != j_rand) continue;
    trial.u[j] = x[i][j] + trial.F * (best[j] - x[i][j]) + trial.F * (x[r1][j] - other[j]);
    if (trial.u[j] > 2.0) trial.u[j] = 0.5 * (x[i][j] + 2.0);
    if (trial.u[j] < -2.0) trial.u[j] = 0.5 * (x[i][j] - 2.0);
  }
  return trial;
}

}  // namespace torquescope::testing
