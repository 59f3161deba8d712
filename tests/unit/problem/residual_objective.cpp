#include "engine/fit/problem/residual_objective.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <limits>

#include "unit/problem/joint_data.hpp"

namespace torquescope {
namespace residual_objective_test {

Bounds unit_box() { return {{-1.0, -1.0, -1.0, -1.0}, {1.0, 1.0, 1.0, 1.0}}; }

std::vector<double> random_candidates(std::size_t members) {
  RandomStream random({5, 0, RandomDomain::test}, 0, 0);
  std::vector<double> rows(4 * members);
  for (auto& x : rows) x = random.uniform(-1.0, 1.0);
  return rows;
}

std::vector<double> fitness_of(ResidualObjective const& objective, std::vector<double> const& rows) {
  Workspace workspace;
  std::vector<double> fitness(rows.size() / 4);
  objective.evaluate({rows.data(), fitness.size(), 4}, fitness, workspace);
  return fitness;
}

double huber(double e, double delta) { return std::abs(e) <= delta ? e * e : delta * (2.0 * std::abs(e) - delta); }

TEST(ResidualObjective, EqualsPlainLoopsForEveryLossAndScale) {
  auto const data = test::seed_data(30.01, 0.3);  // 3001 samples: two blocks and a ragged tile
  auto const rows = random_candidates(31);
  constexpr double delta = 0.4;
  ResidualObjective const mse(data, unit_box()), sse(data, unit_box(), {}, FitnessScale::sse),
      robust(data, unit_box(), {LossKind::huber, delta});
  auto const mse_fitness = fitness_of(mse, rows), sse_fitness = fitness_of(sse, rows),
             huber_fitness = fitness_of(robust, rows);
  for (std::size_t m = 0; m < 31; ++m) {
    double squares = 0.0, pulls = 0.0;
    for (Eigen::Index t = 0; t < data.rows(); ++t) {
      double e = data.tau[t];
      for (Eigen::Index r = 0; r < 4; ++r) e -= data.phi(t, r) * rows[4 * m + static_cast<std::size_t>(r)];
      squares += e * e;
      pulls += huber(e, delta);
    }
    EXPECT_NEAR(sse_fitness[m], squares, 1e-13 * squares);
    EXPECT_NEAR(mse_fitness[m], squares / 3001.0, 1e-13 * squares / 3001.0);
    EXPECT_NEAR(huber_fitness[m], pulls / 3001.0, 1e-13 * pulls / 3001.0);
    EXPECT_EQ(sse_fitness[m] / 3001.0, mse_fitness[m]);
  }
}

TEST(ResidualObjective, IsTheMseOfOlsAtOlsAndNowhereLess) {
  auto const data = test::seed_data(20.0, 0.3);
  ResidualObjective const objective(data, unit_box());
  auto const ols = test::fit("ols", data);
  auto const at_ols = fitness_of(objective, {ols.parameters.begin(), ols.parameters.end()});
  EXPECT_NEAR(at_ols[0], ols.metrics.mse, 1e-13 * ols.metrics.mse);
  for (double const fitness : fitness_of(objective, random_candidates(50))) EXPECT_GT(fitness, ols.metrics.mse);
}

TEST(ResidualObjective, GivesNonFiniteFitnessToNonFiniteCandidatesOnly) {
  auto const data = test::seed_data(5.0, 0.3);
  auto rows = random_candidates(8);
  auto const before = fitness_of(ResidualObjective(data, unit_box()), rows);
  rows[4 * 3 + 1] = std::numeric_limits<double>::quiet_NaN();
  rows[4 * 5 + 2] = std::numeric_limits<double>::infinity();
  for (Loss const& loss : {Loss{}, Loss{LossKind::huber, 0.3}}) {
    ResidualObjective const objective(data, unit_box(), loss);
    auto const fitness = fitness_of(objective, rows);
    for (std::size_t m = 0; m < 8; ++m) EXPECT_EQ(std::isfinite(fitness[m]), m != 3 && m != 5) << m;
    if (loss.kind == LossKind::squares) {
      EXPECT_EQ(fitness[4], before[4]);
    }
  }
}

TEST(ResidualObjective, ReusesALargerWorkspace) {
  auto const data = test::seed_data(5.0, 0.3);
  ResidualObjective const objective(data, unit_box());
  auto const rows = random_candidates(12);
  Workspace workspace;
  std::vector<double> all(12), one(1);
  objective.evaluate({rows.data(), 12, 4}, all, workspace);
  objective.evaluate({rows.data() + 4 * 7, 1, 4}, one, workspace);
  EXPECT_EQ(one[0], all[7]);  // the same bits in any grouping
}

TEST(HuberObjective, OfWideDeltaIsSquares) {
  auto const data = test::seed_data(5.0, 0.3);
  auto const rows = random_candidates(6);
  EXPECT_EQ(fitness_of(ResidualObjective(data, unit_box(), {LossKind::huber, 1e9}), rows),
            fitness_of(ResidualObjective(data, unit_box()), rows));
}

}  // namespace residual_objective_test
}  // namespace torquescope
