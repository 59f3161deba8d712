#include "engine/robot/arm_grams.hpp"

#include <algorithm>
#include <bit>

#include "engine/base/contract.hpp"
#include "engine/base/parallel.hpp"
#include "kernels/aligned_doubles.hpp"
#include "kernels/joint_grams.hpp"
#include "kernels/pairwise_tree.hpp"

namespace torquescope {

namespace {

using Eigen::Index;

// nodes of the tree of blocks that threads share: enough for any machine's balance, few enough to keep
constexpr std::size_t most_nodes = 128;

std::size_t parts_of(std::size_t whole, std::size_t part) { return (whole + part - 1) / part; }

// samples of one node: a power of two of blocks, so that the tree is the same as that of one sweep
std::size_t node_samples(std::size_t n_samples) {
  std::size_t const n_blocks = parts_of(n_samples, kernels::gram_block_samples);
  return std::bit_ceil(std::max<std::size_t>(1, parts_of(n_blocks, most_nodes))) * kernels::gram_block_samples;
}

Eigen::MatrixXd symmetric(double const* upper, Index width) {
  Eigen::MatrixXd products(width, width);
  for (Index i = 0; i < width; ++i)
    for (Index j = i; j < width; ++j) products(i, j) = products(j, i) = *upper++;
  return products;
}

Index count_of(JointSamples const& samples) {
  auto const& weights = samples.root_weight;
  if (weights.empty()) return static_cast<Index>(samples.q.size());
  return std::count_if(weights.begin(), weights.end(), [](double weight) { return weight != 0.0; });
}

}  // namespace

std::vector<JointGram> joint_grams(ArmRows const& rows, std::span<JointSamples const> samples, int threads) {
  auto const& plan = rows.plan();
  TORQUESCOPE_EXPECT(samples.size() == plan.size() && threads >= 1);
  auto const signals = signals_of(samples);
  std::size_t const n = samples.empty() ? 0 : samples.front().q.size(), of_node = node_samples(n);
  std::size_t const n_nodes = parts_of(n, of_node), n_pairs = kernels::pairs_before(plan, plan.size());

  std::size_t const n_threads = std::min(static_cast<std::size_t>(threads), std::max<std::size_t>(1, n_nodes));
  kernels::AlignedDoubles sums(std::max<std::size_t>(1, n_nodes) * n_pairs);
  std::vector<kernels::AlignedDoubles> workspace(
      n_threads, kernels::AlignedDoubles(kernels::joint_grams_workspace_size(plan, std::min(n, of_node))));
  parallel_for(n_nodes, static_cast<int>(n_threads), [&](std::size_t node, int thread) {
    std::size_t const first = node * of_node;
    kernels::joint_grams(plan, signals.data(), first, std::min(of_node, n - first), sums.data() + node * n_pairs,
                         workspace[static_cast<std::size_t>(thread)].data());
  });

  kernels::AlignedDoubles levels(kernels::PairwiseTree::workspace_size(n_nodes, n_pairs));
  kernels::PairwiseTree tree(n_pairs, levels.data());
  for (std::size_t node = 0; node < n_nodes; ++node) tree.add(sums.data() + node * n_pairs);
  tree.total(sums.data());

  std::vector<JointGram> grams;
  for (std::size_t joint = 0; joint < plan.size(); ++joint)
    grams.push_back(
        {symmetric(sums.data() + kernels::pairs_before(plan, joint), static_cast<Index>(plan.row_width(joint))),
         count_of(samples[joint])});
  return grams;
}

}  // namespace torquescope
