// An error from statistics is the error from every sample, along weak directions too; where it would not be, it is
// refused.
#include "engine/fit/problem/sufficient_statistics.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numeric>
#include <set>

#include "engine/base/dense_solvers.hpp"
#include "engine/fit/problem/statistics_objective.hpp"
#include "kernels/dispatch.hpp"
#include "unit/problem/joint_data.hpp"

namespace torquescope {
namespace sufficient_statistics_test {

using testing::HasSubstr;

// columns of random numbers, the last one but `apart` equal to the first; torque of size one plus noise
struct Rows {
  Eigen::MatrixXd phi;
  Eigen::VectorXd tau, truth;

  Rows(Eigen::Index n, Eigen::Index columns, double apart, double noise, std::uint32_t run) {
    RandomStream random({21, run, RandomDomain::test}, 0, 0);
    phi.resize(n, columns);
    for (auto& x : phi.reshaped()) x = random.normal();
    phi.col(columns - 1) = phi.col(0) + apart * phi.col(columns - 1);
    truth.resize(columns);
    for (auto& x : truth) x = random.uniform(-1.0, 1.0);
    tau = phi * truth;
    double const size = std::sqrt(tau.squaredNorm() / static_cast<double>(n));
    for (auto& x : tau) x += noise * size * random.normal();
  }
};

struct Exact {
  long double energy = 0;
  long double spread = 0;     // sum_t (sum_r |phi_tr (v - centre)_r|)^2
  long double magnitude = 0;  // the same with |tau_t| + sum_r |phi_tr centre_r| added before squaring
};

Exact plain_loops(Rows const& rows, Eigen::VectorXd const& v, Eigen::VectorXd const& centre) {
  Exact exact;
  for (Eigen::Index t = 0; t < rows.tau.size(); ++t) {
    long double e = static_cast<long double>(rows.tau[t]), spread = 0, size = std::abs(e);
    for (Eigen::Index r = 0; r < v.size(); ++r) {
      auto const phi = static_cast<long double>(rows.phi(t, r));
      e -= phi * static_cast<long double>(v[r]);
      size += std::abs(phi * static_cast<long double>(centre[r]));
      spread += std::abs(phi * (static_cast<long double>(v[r]) - static_cast<long double>(centre[r])));
    }
    exact.energy += e * e;
    exact.spread += spread * spread;
    exact.magnitude += (spread + size) * (spread + size);
  }
  return exact;
}

double energy_of(SufficientStatistics const& statistics, Eigen::VectorXd const& v) {
  double energy = 0.0;
  kernels::AlignedDoubles workspace(kernels::quadratic_workspace_size(static_cast<std::size_t>(v.size())));
  auto const size = static_cast<std::size_t>(v.size());
  kernels::quadratic_energy(statistics.form(), {v.data(), 1, size}, &energy, workspace.data());
  return energy;
}

// around the centre: at it, near, far, and along the direction the recording hardly sees, as far as the noise hides
std::vector<Eigen::VectorXd> candidates(Rows const& rows, SufficientStatistics const& statistics) {
  auto const columns = rows.phi.cols();
  RandomStream random({22, 0, RandomDomain::test}, 0, 0);
  std::vector<Eigen::VectorXd> found{statistics.centre(), rows.truth};
  for (double const distance : {1e-6, 1e-3, 1.0}) {
    for (int i = 0; i < 10; ++i) {
      Eigen::VectorXd v = statistics.centre();
      for (auto& x : v) x += distance * random.uniform(-1.0, 1.0);
      found.push_back(v);
    }
  }
  auto const svd = right_singular(triangle_of(rows.phi));
  double const noise = std::sqrt(statistics.form().constant);
  for (double const share : {0.1, 1.0, 10.0})
    found.push_back(statistics.centre() + share * noise / svd.values[columns - 1] * svd.vectors.col(columns - 1));
  return found;
}

TEST(SufficientStatistics, EqualPlainLoopsWithinTheStatedError) {
  std::uint32_t run = 0;
  double worst = 0.0, worst_near = 0.0;
  for (Eigen::Index const columns : {2, 4, 11}) {
    for (double const apart : {1.0, 1e-3, 1e-4, 2e-5, 1e-6, 3e-8}) {
      // the last one is just above what is refused
      for (double const noise : {0.3, 1e-2, 1.1e-4}) {
        Rows const rows(3000, columns, apart, noise, ++run);
        SufficientStatistics const statistics(rows.phi, rows.tau);
        ASSERT_TRUE(statistics.usable()) << statistics.refusal();
        double const least = statistics.form().constant;
        for (auto const& v : candidates(rows, statistics)) {
          auto const exact = plain_loops(rows, v, statistics.centre());
          auto const error = std::abs(static_cast<long double>(energy_of(statistics, v)) - exact.energy) / exact.energy;
          // 4 R units of the header's measure, and what the sums of n products round to
          long double const bound = 0x1p-53L * (4 * static_cast<long double>(columns) *
                                                    std::sqrt(exact.magnitude / static_cast<long double>(least)) +
                                                40);
          ASSERT_LE(error, bound) << "R = " << columns << ", apart " << apart << ", noise " << noise;
          worst = std::max(worst, static_cast<double>(error));
          // terms no larger than ten times the torque; beyond, every sample rounds worse in a direct sum too
          if (exact.magnitude <= 100 * static_cast<long double>(rows.tau.squaredNorm()))
            worst_near = std::max(worst_near, static_cast<double>(error));
        }
      }
    }
  }
  EXPECT_LE(worst_near, 1e-12);
  std::printf("largest relative error %.1e; where terms are no larger than ten times the torque %.1e\n", worst,
              worst_near);
}

TEST(SufficientStatistics, AreCentredWhereLeastSquaresIs) {
  auto const data = test::seed_data(30.0, 0.3);
  SufficientStatistics const statistics(data.phi, data.tau);
  ASSERT_TRUE(statistics.usable());
  auto const ols = test::fit("ols", data);
  EXPECT_LT(test::largest_relative_difference(statistics.centre(), ols.parameters), 1e-12);
  EXPECT_NEAR(statistics.form().constant / 3000.0, ols.metrics.mse, 1e-13 * ols.metrics.mse);
  EXPECT_NEAR(statistics.noise_share(), ols.metrics.mse * 3000.0 / data.tau.squaredNorm(), 1e-12);
}

TEST(SufficientStatistics, RefuseDataWithoutNoise) {
  for (double const noise : {0.0, 1e-12, 0.9e-4}) {
    Rows const rows(3000, 4, 1.0, noise, 50);
    SufficientStatistics const statistics(rows.phi, rows.tau);
    EXPECT_FALSE(statistics.usable()) << noise;
    EXPECT_THAT(statistics.refusal(), HasSubstr("of the torque's mean square, below 1e-08"));
  }
}

TEST(SufficientStatistics, RefuseColumnsThatAreNearlyDependent) {
  for (double const apart : {1e-9, 1e-13, 0.0}) {
    Rows const rows(3000, 4, apart, 0.1, 51);
    EXPECT_FALSE(SufficientStatistics(rows.phi, rows.tau).usable()) << apart;
  }
  Rows silent(3000, 4, 1.0, 0.1, 52);
  silent.phi.col(2).setZero();
  EXPECT_EQ(SufficientStatistics(silent.phi, silent.tau).refusal(), "columns are dependent to rounding");
}

TEST(SufficientStatistics, RefuseAsManyParametersAsSamples) {
  Rows const rows(4, 4, 1.0, 0.1, 53);
  EXPECT_EQ(SufficientStatistics(rows.phi, rows.tau).refusal(), "4 samples are too few for 4 parameters");
}

TEST(SufficientStatistics, ColumnsOfUnequalSizeAreNoTrouble) {
  Rows rows(3000, 4, 1.0, 0.1, 54);
  rows.phi.col(1) *= 1e9;
  rows.phi.col(3) *= 1e-7;
  SufficientStatistics const statistics(rows.phi, rows.tau);
  EXPECT_TRUE(statistics.usable()) << statistics.refusal();
  EXPECT_LT(statistics.condition(), 10.0);
}

Bounds unit_box() { return {{-1.0, -1.0, -1.0, -1.0}, {1.0, 1.0, 1.0, 1.0}}; }

TEST(StatisticsObjective, RanksCandidatesAsEverySampleDoes) {
  auto const data = test::seed_data(30.01, 0.3);
  SufficientStatistics const statistics(data.phi, data.tau);
  RandomStream random({23, 0, RandomDomain::test}, 0, 0);
  std::vector<double> rows(4 * 200);
  // shrinking towards the optimum, as a population does
  for (std::size_t i = 0; i < rows.size(); ++i)
    rows[i] = statistics.centre()[static_cast<Eigen::Index>(i % 4)] +
              std::ldexp(random.uniform(-1.0, 1.0), -static_cast<int>(i / 80));
  for (auto const scale : {FitnessScale::mse, FitnessScale::sse}) {
    ResidualObjective const direct(data, unit_box(), {}, scale);
    StatisticsObjective const quick(statistics, 3001, unit_box(), scale);
    Workspace workspace;
    std::vector<double> from_samples(200), from_statistics(200);
    direct.evaluate({rows.data(), 200, 4}, from_samples, workspace);
    quick.evaluate({rows.data(), 200, 4}, from_statistics, workspace);
    std::vector<std::size_t> order(200);
    std::iota(order.begin(), order.end(), 0u);
    std::sort(order.begin(), order.end(), [&](auto a, auto b) { return from_samples[a] < from_samples[b]; });
    for (std::size_t i = 1; i < 200; ++i) EXPECT_LT(from_statistics[order[i - 1]], from_statistics[order[i]]) << i;
    for (std::size_t i = 0; i < 200; ++i) EXPECT_NEAR(from_statistics[i] / from_samples[i], 1.0, 1e-13);
  }
}

TEST(SufficientStatistics, HaveTheSameBitsOnEveryInstructionSet) {
  Rows const rows(5000, 11, 1e-3, 0.1, 55);
  std::set<std::vector<double>> all;
  for (auto const name : kernels::supported_instruction_sets()) {
    ASSERT_TRUE(kernels::force_instruction_set(name));
    SufficientStatistics const statistics(rows.phi, rows.tau);
    auto const form = statistics.form();
    std::vector<double> numbers(form.root, form.root + 121);
    numbers.insert(numbers.end(), form.centre, form.centre + 11);
    numbers.insert(numbers.end(), form.slope, form.slope + 11);
    numbers.push_back(form.constant);
    all.insert(numbers);
  }
  kernels::release_instruction_set();
  EXPECT_EQ(all.size(), 1u);
}

}  // namespace sufficient_statistics_test
}  // namespace torquescope
