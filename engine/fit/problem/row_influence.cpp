#include "engine/fit/problem/row_influence.hpp"

#include <algorithm>
#include <cmath>

#include "engine/base/dense_solvers.hpp"

namespace torquescope {
namespace {

constexpr Eigen::Index fewest_blocks = 10;

// rows [first, end) of one recording
struct LeftOutRows {
  Eigen::Index first, end;
  Eigen::Index count() const { return end - first; }
};

}  // namespace

struct RowInfluences::State {
  RegressionData const& data;
  Eigen::VectorXd parameters;
  Eigen::Index half_width;
  Eigen::VectorXd scale;  // of the columns: products of unlike columns lose digits
  Eigen::MatrixXd phi, product;
  Eigen::VectorXd residual;

  // what the block adds to the scaled parameters
  Eigen::VectorXd change(LeftOutRows const& block, Eigen::VectorXd const& residual_now) const {
    auto const rows = phi.middleRows(block.first, block.count());
    Eigen::MatrixXd const others = product - rows.transpose() * rows;
    return solve_semidefinite(others,
                              Eigen::VectorXd(rows.transpose() * residual_now.segment(block.first, block.count())));
  }

  LeftOutRows block_around(Eigen::Index row) const {
    auto const k = data.recording_of(row);
    return {std::max(data.first_row[k], row - half_width), std::min(data.first_row[k + 1], row + half_width + 1)};
  }

  // s^2 of the header: blocks of one length side by side, none of them on the one left out
  Eigen::VectorXd variance_without(LeftOutRows const& left_out) const {
    Eigen::VectorXd const residual_now = residual + phi * change(left_out, residual);
    Eigen::VectorXd sum = Eigen::VectorXd::Zero(data.parameters());
    for (std::size_t k = 0; k < data.recordings(); ++k)
      for (Eigen::Index first = data.first_row[k]; first < data.first_row[k + 1]; first += 2 * half_width + 1) {
        LeftOutRows const block{first, std::min(first + 2 * half_width + 1, data.first_row[k + 1])};
        if (block.first < left_out.end && left_out.first < block.end) continue;
        sum += change(block, residual_now).cwiseAbs2();
      }
    return sum;
  }
};

RowInfluences::RowInfluences(RegressionData const& data, Eigen::VectorXd const& parameters, Eigen::Index half_width) {
  Eigen::VectorXd const scale = data.phi.colwise().norm().transpose().cwiseMax(1e-300);
  Eigen::MatrixXd const phi = data.phi * scale.cwiseInverse().asDiagonal();
  state_ = std::make_unique<State const>(
      State{data, parameters, half_width, scale, phi, phi.transpose() * phi, data.tau - data.phi * parameters});
}

RowInfluences::~RowInfluences() = default;

std::vector<RowInfluence> RowInfluences::of(Eigen::Index row) const {
  auto const& data = state_->data;
  if (data.rows() < fewest_blocks * (2 * state_->half_width + 1)) return {};
  auto const block = state_->block_around(row);
  Eigen::VectorXd const change = state_->change(block, state_->residual);
  Eigen::VectorXd const variance = state_->variance_without(block);
  std::vector<RowInfluence> influences;
  for (Eigen::Index j = 0; j < data.parameters(); ++j) {
    if (!(variance[j] > 0.0)) continue;
    double const moved = change[j] / state_->scale[j];
    influences.push_back({j, state_->parameters[j] - moved, moved, std::fabs(change[j]) / std::sqrt(variance[j])});
  }
  return influences;
}

}  // namespace torquescope
