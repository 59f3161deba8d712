#include "engine/fit/problem/hac_bias.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <vector>

#include "engine/base/contract.hpp"

namespace torquescope {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

// rows of one joint of one recording, in the order of their instants
struct Block {
  Index first = 0, end = 0;
  std::size_t recording = 0;
  VectorXd covariance{};  // [lags + 1] of the reference noise
};

double bartlett(Index distance, Index lags) {
  return 1.0 - static_cast<double>(distance) / static_cast<double>(lags + 1);
}

// visit(first, count) of the rows of a block within `lags` of an instant
template <class Visit>
void visit_near(Block const& block, std::vector<Index> const& instant, Index at, Index lags, Visit const& visit) {
  auto const begin = instant.begin() + block.first, end = instant.begin() + block.end;
  auto const from = std::lower_bound(begin, end, at - lags), to = std::upper_bound(from, end, at + lags);
  if (to > from) visit(static_cast<Index>(from - instant.begin()), static_cast<Index>(to - from));
}

// Of the residual with zeros where rows are left out, over all rows alike: positive semidefinite, and so with a taper
VectorXd tapered_autocovariance(Block const& block, std::vector<Index> const& instant, VectorXd const& residual,
                                Index lags) {
  VectorXd sums = VectorXd::Zero(lags + 1);
  for (Index t = block.first; t < block.end; ++t)
    for (Index s = t; s >= block.first; --s) {
      Index const distance = instant[static_cast<std::size_t>(t)] - instant[static_cast<std::size_t>(s)];
      if (distance > lags) break;
      sums[distance] += residual[t] * residual[s];
    }
  for (Index lag = 0; lag <= lags; ++lag)
    sums[lag] *= bartlett(lag, lags) / static_cast<double>(std::max<Index>(block.end - block.first, 1));
  return sums;
}

std::vector<Block> blocks_of(RegressionData const& data, VectorXd const& residual, Index lags) {
  std::vector<Block> blocks;
  for (std::size_t k = 0; k < data.recordings(); ++k) {
    Block block{data.first_row[k], data.first_row[k + 1], k / data.arm->joints()};
    block.covariance = tapered_autocovariance(block, data.arm->instant, residual, lags);
    blocks.push_back(std::move(block));
  }
  return blocks;
}

// Omega times columns; [R][n], as all that follows: a row of the data is contiguous
MatrixXd times_noise(std::vector<Block> const& blocks, std::vector<Index> const& instant, MatrixXd const& columns,
                     Index lags) {
  MatrixXd product = MatrixXd::Zero(columns.rows(), columns.cols());
  for (auto const& block : blocks)
    for (Index t = block.first; t < block.end; ++t) {
      Index const at = instant[static_cast<std::size_t>(t)];
      visit_near(block, instant, at, lags, [&](Index first, Index count) {
        for (Index s = first; s < first + count; ++s)
          product.col(t) += block.covariance[std::abs(at - instant[static_cast<std::size_t>(s)])] * columns.col(s);
      });
    }
  return product;
}

struct Reference {
  MatrixXd rows;       // P', [R][n]
  MatrixXd gains;      // g', [R][n]
  MatrixXd depletion;  // f': (I - H) Omega (I - H)' = Omega - P f' - f P'
};

// E, [R]
VectorXd expected_variances(Reference const& reference, std::vector<Block> const& blocks,
                            std::vector<Index> const& instant, Index lags) {
  VectorXd sum = VectorXd::Zero(reference.rows.rows()), kernel;
  for (auto const& own : blocks)
    for (auto const& other : blocks) {
      if (own.recording != other.recording) continue;
      bool const same = own.first == other.first;
      for (Index t = own.first; t < own.end; ++t) {
        Index const at = instant[static_cast<std::size_t>(t)];
        visit_near(other, instant, at, lags, [&](Index first, Index count) {
          // p_t f_s' stands for its transpose as well: the double sum is symmetric
          kernel.noalias() = -2.0 * reference.depletion.middleCols(first, count).transpose() * reference.rows.col(t);
          for (Index s = 0; s < count; ++s) {
            Index const distance = std::abs(at - instant[static_cast<std::size_t>(first + s)]);
            if (same) kernel[s] += own.covariance[distance];
            kernel[s] *= bartlett(distance, lags);
          }
          sum.array() += reference.gains.col(t).array() * (reference.gains.middleCols(first, count) * kernel).array();
        });
      }
    }
  return sum;
}

}  // namespace

VectorXd hac_bias_factors(RegressionData const& data, VectorXd const& parameters, VectorXd const& weights,
                          MatrixXd const& bread, std::int64_t lags) {
  TORQUESCOPE_EXPECT(data.arm.has_value() && lags >= 0);
  VectorXd const residual = data.tau - data.phi * parameters;
  auto const& instant = data.arm->instant;
  auto const blocks = blocks_of(data, residual, lags);
  Reference reference;
  reference.rows = data.phi.transpose();
  MatrixXd weighted = reference.rows;
  if (weights.size() > 0) weighted *= weights.asDiagonal();
  reference.gains = bread * weighted;
  MatrixXd const noisy = times_noise(blocks, instant, weighted, lags);
  MatrixXd const variance = bread * (noisy * weighted.transpose()) * bread;
  reference.depletion = bread * noisy - 0.5 * variance * reference.rows;
  VectorXd const expected = expected_variances(reference, blocks, instant, lags);

  auto const n = static_cast<double>(data.arm->first_instant.back());
  double const freedom = n / (n - static_cast<double>(data.parameters()));
  VectorXd factors(data.parameters());
  for (Index k = 0; k < factors.size(); ++k) {
    double const factor = variance(k, k) / expected[k];
    factors[k] = expected[k] > 0.0 && std::isfinite(factor) && factor > 0.0 ? factor : freedom;
  }
  return factors;
}

}  // namespace torquescope
