#include "kernels/pairwise_tree.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <random>
#include <vector>

namespace torquescope::kernels {
namespace pairwise_tree_test {

// the equation of the header
double split_sum(std::vector<double> const& terms, std::size_t first, std::size_t count) {
  if (count == 0) return 0.0;
  if (count == 1) return terms[first];
  std::size_t const half = std::bit_floor(count - 1);
  return split_sum(terms, first, half) + split_sum(terms, first + half, count - half);
}

TEST(PairwiseTree, SumsByHalvingAtPowersOfTwo) {
  std::mt19937 random(7);
  std::normal_distribution<double> normal;
  for (std::size_t count = 0; count < 70; ++count) {
    std::vector<double> terms(count);
    for (double& term : terms) term = normal(random);
    std::vector<double> workspace(PairwiseTree::workspace_size(count, 1));
    PairwiseTree tree(1, workspace.data());
    for (double term : terms) tree.add(&term);
    double sum = 1.0;
    tree.total(&sum);
    EXPECT_EQ(sum, split_sum(terms, 0, count)) << count << " terms";
  }
}

TEST(PairwiseTree, KeepsColumnsApart) {
  std::vector<double> workspace(PairwiseTree::workspace_size(5, 3));
  PairwiseTree tree(3, workspace.data());
  for (double i = 1; i <= 5; ++i) {
    double term[3] = {i, 10 * i, 100 * i};
    tree.add(term);
  }
  double sum[3];
  tree.total(sum);
  EXPECT_EQ(sum[0], 15.0);
  EXPECT_EQ(sum[1], 150.0);
  EXPECT_EQ(sum[2], 1500.0);
}

}  // namespace pairwise_tree_test
}  // namespace torquescope::kernels
