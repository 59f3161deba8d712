// Products of an arm's rows against plain products; their documented order; the same bits from any threads.
#include "engine/robot/arm_grams.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "kernels/dispatch.hpp"
#include "kernels/joint_grams.hpp"
#include "unit/kernels/documented_sum.hpp"
#include "unit/robot/arm_signals.hpp"
#include "unit/robot/example_arms.hpp"

namespace torquescope {
namespace arm_grams_test {

using Eigen::Index;

struct Arm {
  SerialChain chain;
  BaseParameters base;
  ArmRows rows;

  explicit Arm(SerialChain const& from)
      : chain(from),
        base(chain, DriveInertias::included),
        rows(chain, base, std::vector<FrictionColumns>(chain.joints.size())) {}
};

void expect_plain_products(SerialChain const& chain, Index n_samples) {
  Arm const arm(chain);
  test::ArmSignals const signals(n_samples, chain.size(), 11);
  auto const grams = joint_grams(arm.rows, signals.samples(), 1);
  ASSERT_EQ(static_cast<Index>(grams.size()), chain.size());
  for (Index joint = 0; joint < chain.size(); ++joint) {
    auto const& gram = grams[static_cast<std::size_t>(joint)];
    Eigen::MatrixXd const rows = arm.rows.rows(signals.samples(), joint), plain = rows.transpose() * rows;
    ASSERT_EQ(gram.products.rows(), rows.cols());
    EXPECT_EQ(gram.products, gram.products.transpose());
    // relative to the lengths of the two columns
    Eigen::VectorXd const length = rows.colwise().norm();
    for (Index i = 0; i < rows.cols(); ++i)
      for (Index j = 0; j < rows.cols(); ++j)
        EXPECT_LE(std::abs(gram.products(i, j) - plain(i, j)), 1e-12 * length[i] * length[j]) << joint << i << j;
    EXPECT_EQ(gram.count, (signals.root_weight.col(joint).array() != 0.0).count());
  }
}

TEST(JointGrams, ArePlainProducts) {
  for (Index const n : {1, 8, 130, 2048, 5000}) expect_plain_products(test::crs_a465(5), n);
  expect_plain_products(test::ur10e(), 3000);
  expect_plain_products(test::panda(), 3000);
  expect_plain_products(test::puma_560(), 3000);
  for (std::uint32_t number = 0; number < 30; ++number)
    expect_plain_products(test::random_arm(number, number % 2 == 0).chain, 300);
}

TEST(JointGrams, OfNoSamplesAreZero) {
  Arm const arm(test::crs_a465(3));
  auto const grams = joint_grams(arm.rows, std::vector<JointSamples>(3), 2);
  ASSERT_EQ(grams.size(), 3U);
  for (auto const& gram : grams) {
    EXPECT_EQ(gram.products.norm(), 0.0);
    EXPECT_EQ(gram.count, 0);
  }
}

TEST(JointGrams, TakeEveryRowWhereNoWeightIsGiven) {
  Arm const arm(test::crs_a465(4));
  test::ArmSignals signals(500, 4, 2);
  signals.root_weight.setOnes();
  auto const weighted = signals.samples();
  auto plain = weighted;
  for (auto& joint : plain) joint.root_weight = {};
  auto const expected = joint_grams(arm.rows, weighted, 1), grams = joint_grams(arm.rows, plain, 1);
  for (std::size_t joint = 0; joint < 4; ++joint) {
    EXPECT_EQ(grams[joint].products, expected[joint].products);
    EXPECT_EQ(grams[joint].count, 500);
  }
}

double product_in_documented_order(Eigen::MatrixXd const& rows, Index i, Index j) {
  std::vector<double> blocks;
  auto const block = static_cast<Index>(kernels::gram_block_samples);
  for (Index first = 0; first < rows.rows(); first += block) {
    std::array<double, 8> lane{};
    for (Index t = first; t < std::min(first + block, rows.rows()); ++t) {
      auto& sum = lane.at(static_cast<std::size_t>(t % 8));
      sum = std::fma(rows(t, i), rows(t, j), sum);
    }
    blocks.push_back(kernels::sum_of_lanes(lane));
  }
  return kernels::sum_of_blocks(std::move(blocks));
}

TEST(JointGrams, SumInTheDocumentedOrder) {
  Arm const arm(test::crs_a465(4));
  test::ArmSignals const signals(3 * 2048 + 77, 4, 3);
  auto const grams = joint_grams(arm.rows, signals.samples(), 1);
  for (Index joint = 0; joint < 4; ++joint) {
    auto const rows = arm.rows.rows(signals.samples(), joint);
    auto const& products = grams[static_cast<std::size_t>(joint)].products;
    for (Index i = 0; i < rows.cols(); ++i)
      for (Index j = i; j < rows.cols(); ++j)
        ASSERT_EQ(products(i, j), product_in_documented_order(rows, i, j)) << joint << " " << i << " " << j;
  }
}

TEST(JointGrams, HaveTheSameBitsOnEveryInstructionSet) {
  for (auto const& chain : {test::crs_a465(5), test::random_arm(8, true).chain, test::random_arm(9, false).chain}) {
    Arm const arm(chain);
    test::ArmSignals const signals(2048 + 77, chain.size(), 4);
    auto const best = joint_grams(arm.rows, signals.samples(), 1);
    for (auto const name : kernels::supported_instruction_sets()) {
      ASSERT_TRUE(kernels::force_instruction_set(name));
      auto const grams = joint_grams(arm.rows, signals.samples(), 1);
      for (std::size_t joint = 0; joint < best.size(); ++joint)
        EXPECT_EQ(grams[joint].products, best[joint].products) << name;
    }
    kernels::release_instruction_set();
  }
}

// more blocks than nodes, so that a node has several
TEST(JointGrams, HaveTheSameBitsFromAnyNumberOfThreads) {
  Arm const arm(test::crs_a465(2));
  test::ArmSignals const signals(300 * 2048 + 77, 2, 6);
  auto const alone = joint_grams(arm.rows, signals.samples(), 1);
  for (int const threads : {2, 3, 5}) {
    auto const grams = joint_grams(arm.rows, signals.samples(), threads);
    for (std::size_t joint = 0; joint < 2; ++joint) EXPECT_EQ(grams[joint].products, alone[joint].products) << threads;
  }
  auto const rows = arm.rows.rows(signals.samples(), 1);
  EXPECT_EQ(alone[1].products(0, 1), product_in_documented_order(rows, 0, 1));
}

}  // namespace arm_grams_test
}  // namespace torquescope
