// The energy that twins do not have is none when nothing is missing, and all of what is planted when something is.

#include "engine/infer/replicates/mismatch_energy.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "unit/replicates/synthetic_rows.hpp"

namespace torquescope {
namespace mismatch_energy_test {

constexpr std::uint32_t sets = 600;

// noise with a memory, as a filter leaves it
test::SyntheticPlan plan_of(std::uint32_t set, Eigen::Index twins) { return {400, 100.0, twins, 0.6, set}; }

struct Average {
  double sum = 0.0, squares = 0.0;
  int count = 0;

  void add(double value) {
    sum += value;
    squares += value * value;
    ++count;
  }
  double mean() const { return sum / count; }
  double variance() const { return squares / count - mean() * mean(); }
  double error() const { return std::sqrt(variance() / count); }
};

// few twins: every factor of M counts most
TEST(MismatchEnergy, HasNoExcessOnAverageWhenTheRecordingIsOneMoreTwin) {
  Average excess, noise;
  for (std::uint32_t set = 0; set < sets; ++set) {
    MismatchRows const rows = test::synthetic_rows(plan_of(set, 8)).rows;
    MismatchEnergy const found = mismatch_energy(rows);
    EXPECT_EQ(found.rows, rows.size());
    EXPECT_DOUBLE_EQ(found.residual, rows.residual.squaredNorm());
    excess.add(found.excess / static_cast<double>(rows.size()));
    noise.add(found.noise / static_cast<double>(rows.size()));
  }
  EXPECT_LT(std::abs(excess.mean()), 3.0 * excess.error());
  EXPECT_LT(excess.error(), 0.01);  // of the noise: the line above says something
  EXPECT_NEAR(noise.mean(), 1.0, 4.0 * noise.error());
}

TEST(MismatchEnergy, HasAStandardNormalZAndAUniformP) {
  constexpr Eigen::Index twins = 30;
  Average z;
  double below_5 = 0.0, below_half = 0.0;
  for (std::uint32_t set = 0; set < sets; ++set) {
    MismatchEnergy const found = mismatch_energy(test::synthetic_rows(plan_of(sets + set, twins)).rows);
    z.add(found.z);
    below_5 += found.p <= 0.05;
    below_half += found.p <= 0.5;
  }
  EXPECT_NEAR(z.mean(), 0.0, 3.5 * z.error());
  // of Student's t with M - 1 degrees of freedom; its sample variance spreads by sqrt(2 / sets), tails a little more
  EXPECT_NEAR(z.variance(), (twins - 1.0) / (twins - 3.0), 4.0 * std::sqrt(2.0 / sets));
  // steps of 1 / (M + 1): of ranks 1 and 15
  auto const near = [](double count, double share) {
    EXPECT_NEAR(count / sets, share, 3.5 * std::sqrt(share * (1.0 - share) / sets));
  };
  near(below_5, 1.0 / (twins + 1.0));
  near(below_half, 15.0 / (twins + 1.0));
}

TEST(MismatchEnergy, FindsThePlantedEnergy) {
  constexpr Eigen::Index twins = 60;
  Average share;
  for (std::uint32_t set = 0; set < 100; ++set) {
    auto made = test::synthetic_rows({1500, 100.0, twins, 0.6, set});
    double planted = 0.0;
    made.plant([&](MismatchRows const& rows, Eigen::Index i) {
      double const torque = 1.5 * std::sin(4.0 * rows.q[i]);
      planted += torque * torque;
      return torque;
    });
    MismatchEnergy const found = mismatch_energy(made.rows);
    EXPECT_GT(found.z, 4.0);
    EXPECT_EQ(found.p, 1.0 / (twins + 1.0));
    EXPECT_NEAR(found.excess_rms(), std::sqrt(found.excess / static_cast<double>(found.rows)), 1e-12);
    share.add(found.excess / planted);
  }
  // all of it but the 1 / (1 + 1/M) that the scale takes
  EXPECT_NEAR(share.mean(), 1.0 / (1.0 + 1.0 / twins), 3.5 * share.error());
  EXPECT_LT(share.error(), 0.02);
}

TEST(MismatchEnergy, BelowTheNoiseHasNoRms) {
  auto made = test::synthetic_rows(plan_of(1, 20));
  made.rows.residual = made.rows.twin_mean;
  MismatchEnergy const found = mismatch_energy(made.rows);
  EXPECT_DOUBLE_EQ(found.excess, -found.noise);
  EXPECT_EQ(found.excess_rms(), 0.0);
  EXPECT_LT(found.z, -4.0);
  EXPECT_EQ(found.p, 1.0);
}

}  // namespace mismatch_energy_test
}  // namespace torquescope
