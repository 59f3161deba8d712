// Products of rows of every width against plain loops: the same bits on every instruction set, nothing else written.
#include "kernels/joint_grams.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "unit/kernels/every_instruction_set.hpp"

namespace torquescope::kernels {
namespace joint_grams_test {

class JointGrams : public EveryInstructionSet {};

INSTANTIATE_TEST_SUITE_P(Target, JointGrams, testing::ValuesIn(supported_instruction_sets()), instruction_set_of);

std::vector<double> random_numbers(std::size_t n, std::uint32_t seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  std::vector<double> numbers(n);
  for (auto& number : numbers) number = normal(random);
  return numbers;
}

TEST_P(JointGrams, AddProductsOfRowsOfAnyWidth) {
  constexpr std::size_t n_groups = 3, guard = 64;
  for (std::size_t width = 1; width <= 18; ++width) {
    auto const rows = random_numbers(n_groups * width * n_lanes, static_cast<std::uint32_t>(width));
    std::size_t const n_lane_sums = width * (width + 1) / 2 * n_lanes;
    auto lanes = random_numbers(n_lane_sums + guard, 99);
    auto expected = lanes;
    double* sum = expected.data();
    for (std::size_t i = 0; i < width; ++i)
      for (std::size_t j = i; j < width; ++j)
        for (std::size_t lane = 0; lane < n_lanes; ++lane, ++sum)
          for (std::size_t group = 0; group < n_groups; ++group) {
            double const* const of_group = rows.data() + group * width * n_lanes + lane;
            *sum = std::fma(of_group[i * n_lanes], of_group[j * n_lanes], *sum);
          }
    add_products(rows.data(), width, n_groups, lanes.data());
    EXPECT_EQ(lanes, expected) << width;
  }
}

// a joint that turns and one that slides behind it, all columns and none
ArmPlan small_plan() {
  ArmJoint first, second;
  first.link_columns = 0x3ff;
  first.own_columns = own_acceleration | own_speed | own_direction | own_one;
  second.motion = JointMotion::slides;
  second.sin_alpha = 1.0;
  second.cos_alpha = 0.0;
  second.link_columns = 0x3ff;
  return {{first, second}, {0.0, 0.0, -9.81}};
}

TEST_P(JointGrams, WriteOnlyPairsAndWorkspace) {
  auto const plan = small_plan();
  std::size_t const n = 5000, guard = 64, n_pairs = pairs_before(plan, plan.size());
  ASSERT_EQ(n_pairs, 25U * 26U / 2U + 11U * 12U / 2U);
  auto const numbers = random_numbers(4 * n, 1);
  JointSignals const signal{numbers.data(), numbers.data() + n, numbers.data() + 2 * n, numbers.data() + 3 * n};
  std::vector<JointSignals> const signals{signal, signal};
  std::size_t const size = joint_grams_workspace_size(plan, n);
  std::vector<double> pairs(n_pairs + guard, 12345.0), workspace(size + guard, 12345.0);
  joint_grams(plan, signals.data(), 0, n, pairs.data(), workspace.data());
  for (std::size_t i = 0; i < guard; ++i) {
    EXPECT_EQ(pairs[n_pairs + i], 12345.0);
    EXPECT_EQ(workspace[size + i], 12345.0);
  }
  // the last of a joint's pairs is torque by torque, which both have
  EXPECT_EQ(pairs[n_pairs - 1], pairs[pairs_before(plan, 1) - 1]);
}

}  // namespace joint_grams_test
}  // namespace torquescope::kernels
