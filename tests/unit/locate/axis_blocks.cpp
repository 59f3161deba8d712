// Blocks along an effect's axis: where a law of another form is, an interval over blocks of time is too narrow, over
// levels it is not.

#include "engine/infer/locate/axis_blocks.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "engine/fit/statistics/block_jackknife.hpp"

using torquescope::axis_blocks;
using torquescope::AxisBlocks;
using torquescope::CoefficientBounds;
using torquescope::Effect;
using torquescope::find_effect;
using torquescope::jackknife_deviations;
using torquescope::MotionAxes;

namespace axis_blocks_test {

constexpr Eigen::Index n = 4000;
constexpr Eigen::Index n_levels = 10;

// the speed goes through all its levels many times in every tenth of the record
MotionAxes oscillating() {
  MotionAxes axes;
  axes.time_s = Eigen::VectorXd::LinSpaced(n, 0.0, 40.0);
  axes.dq = (3.0 * axes.time_s).array().cos() + 0.4 * (7.3 * axes.time_s).array().cos();
  axes.q = (3.0 * axes.time_s).array().sin() / 3.0;
  return axes;
}

Eigen::VectorXd noise(double std) {
  std::mt19937_64 random(11);
  std::normal_distribution<double> normal(0.0, std);
  Eigen::VectorXd values(n);
  for (double& one : values) one = normal(random);
  return values;
}

// of a quadratic drag fitted to `signal`
struct Deviations {
  double over_time = 0.0, over_levels = 0.0, error = 0.0;
};

Deviations deviations_of_drag(Eigen::VectorXd const& signal, double truth) {
  MotionAxes const axes = oscillating();
  Eigen::MatrixXd const drag = axes.dq.cwiseProduct(axes.dq.cwiseAbs());
  Eigen::VectorXd const any = Eigen::VectorXd::Constant(1, std::numeric_limits<double>::infinity());
  CoefficientBounds const free{-any, any};
  AxisBlocks const levels = axis_blocks(*find_effect("speed_drag"), axes, drag.col(0), n_levels);
  double const fit = drag.col(0).dot(signal) / drag.squaredNorm();
  return {jackknife_deviations(signal, drag, free)[0],
          jackknife_deviations(signal(levels.order), drag(levels.order, Eigen::all), free, levels.blocks)[0],
          std::abs(fit - truth)};
}

TEST(AxisBlocks, AreAPermutationOfTheRowsAlongTheSpeedInBlocksThatWeighAlike) {
  MotionAxes const axes = oscillating();
  Eigen::VectorXd const drag = axes.dq.cwiseProduct(axes.dq.cwiseAbs());
  auto const [order, blocks] = axis_blocks(*find_effect("speed_drag"), axes, drag, n_levels);
  ASSERT_EQ(order.size(), static_cast<std::size_t>(n));
  std::vector<bool> seen(order.size(), false);
  for (auto row : order) seen[static_cast<std::size_t>(row)] = true;
  EXPECT_EQ(std::count(seen.begin(), seen.end(), true), n);
  for (std::size_t k = 1; k < order.size(); ++k)
    ASSERT_LE(std::abs(axes.dq[order[k - 1]]), std::abs(axes.dq[order[k]]));
  ASSERT_EQ(blocks.size(), static_cast<std::size_t>(n_levels));
  EXPECT_EQ(blocks.front().from, 0);
  EXPECT_EQ(blocks.back().to, n);
  for (auto const& block : blocks) {
    double weight = static_cast<double>(block.size()) / n;
    for (auto k = block.from; k < block.to; ++k)
      weight += std::pow(drag[order[static_cast<std::size_t>(k)]], 2) / drag.squaredNorm();
    EXPECT_NEAR(weight, 0.2, 0.01);
  }
}

TEST(AxisBlocks, ShowALawOfAnotherFormThatEveryStretchOfTimeShowsAlike) {
  MotionAxes const axes = oscillating();
  // grows with the cube of the speed where the square was fitted; at the speed 1 it has the same number
  Eigen::VectorXd const cubic = axes.dq.array().cube();
  Deviations const found = deviations_of_drag(cubic + noise(0.01), 1.0);
  EXPECT_GT(found.over_levels, 5.0 * found.over_time);
  EXPECT_LT(found.error, 2.262 * found.over_levels);
  EXPECT_GT(found.error, 2.262 * found.over_time);
}

TEST(AxisBlocks, AreAsWideAsChanceWhereTheLawIsRight) {
  MotionAxes const axes = oscillating();
  Eigen::VectorXd const drag = axes.dq.cwiseProduct(axes.dq.cwiseAbs());
  Deviations const found = deviations_of_drag(drag + noise(0.1), 1.0);
  EXPECT_NEAR(found.over_levels * drag.norm() / 0.1, 1.0, 0.6);
}

TEST(AxisBlocks, ThereAreNoneForWhatGoesWithTime) {
  MotionAxes const axes = oscillating();
  EXPECT_TRUE(axis_blocks(*find_effect("sensor_drift"), axes, axes.dq, n_levels).order.empty());
  EXPECT_TRUE(axis_blocks(*find_effect("periodic_disturbance"), axes, axes.dq, n_levels).order.empty());
}

}  // namespace axis_blocks_test
