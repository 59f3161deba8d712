#include "engine/infer/replicates/friction_wander.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "engine/fit/statistics/hat_functions.hpp"

namespace torquescope {
namespace {

constexpr std::size_t most_blocks = 24, fewest_blocks = 8;
constexpr double shortest_block_s = 2.0;
// all joints have some: also where none is seen, twins draw about none
constexpr double always = -std::numeric_limits<double>::infinity();

// of the motion, and the parabola through what friction does over time
Eigen::MatrixXd smooth_functions(Motion const& motion, Eigen::VectorXd const& friction, WanderReading reading) {
  Eigen::VectorXd const t = Eigen::VectorXd::LinSpaced(friction.size(), -1.0, 1.0);
  Eigen::VectorXd const level = friction / std::max(friction.cwiseAbs().maxCoeff(), std::numeric_limits<double>::min());
  std::vector<Eigen::MatrixXd> parts{level, level.cwiseProduct(t), level.cwiseProduct(t.cwiseAbs2())};
  if (reading == WanderReading::beside_motion) {
    Eigen::VectorXd const s = motion.dq.array().sign();
    for (Eigen::VectorXd const* of : {&motion.q, &motion.ddq}) {
      parts.push_back(hats(*of, 8));
      parts.push_back(s.asDiagonal() * parts.back());
    }
    parts.push_back(hats(motion.dq, 12));
  }
  return side_by_side(parts);
}

}  // namespace

FrictionWander::FrictionWander(ProcessedRecord const& recording, RecordPipeline const& pipeline, TwinJoint const& joint,
                               WanderReading reading)
    : pipeline_(&pipeline) {
  if (joint.coulomb_forward == 0.0 && joint.coulomb_backward == 0.0) return;
  double const duration_s = static_cast<double>(pipeline.kept_samples()) / pipeline.kept_rate_hz();
  auto const blocks = std::min(most_blocks, static_cast<std::size_t>(duration_s / shortest_block_s));
  if (blocks < fewest_blocks) return;
  blocks_ = blocks;
  duration_s_ = duration_s;
  Motion kept;
  kept.q = pipeline.picked(recording.motion->q);
  kept.dq = pipeline.picked(recording.motion->dq);
  kept.ddq = pipeline.picked(recording.motion->ddq);
  friction_ = kept.dq.unaryExpr([&](double v) { return v > 0.0 ? joint.coulomb_forward : joint.coulomb_backward; });
  smooth_ = smooth_functions(kept, friction_, reading);
}

std::vector<double> FrictionWander::changes(ProcessedRecord const& record) const {
  constexpr double enough = 0.2;  // of the rows that a block would have if all had the same
  auto const& rows = record.kept_rows;
  Eigen::MatrixXd smooth = smooth_(rows, Eigen::all);
  Eigen::VectorXd level = friction_(rows);
  Eigen::VectorXd residual = record.residual_itself();
  pipeline_->whiten_rows(smooth, rows);
  pipeline_->whiten_rows(level, rows);
  pipeline_->whiten_rows(residual, rows);
  Eigen::VectorXd const left = left_of(residual, smooth);
  std::vector<double> product(blocks_, 0.0), square(blocks_, 0.0);
  std::vector<std::size_t> count(blocks_, 0);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    std::size_t const block = static_cast<std::size_t>(rows[i]) * blocks_ / static_cast<std::size_t>(friction_.size());
    double const friction = level[static_cast<Eigen::Index>(i)];
    product[block] += friction * left[static_cast<Eigen::Index>(i)];
    square[block] += friction * friction;
    ++count[block];
  }
  std::vector<double> change(blocks_, std::numeric_limits<double>::quiet_NaN());
  for (std::size_t block = 0; block < blocks_; ++block)
    if (static_cast<double>(count[block] * blocks_) >= enough * static_cast<double>(rows.size()) && square[block] > 0.0)
      change[block] = product[block] / square[block];
  return change;
}

double FrictionWander::operator()(ProcessedRecord const& record) const {
  constexpr double kept = 0.8;
  std::vector<double> squares;
  for (double const change : changes(record))
    if (std::isfinite(change)) squares.push_back(change * change);
  auto const n = static_cast<std::size_t>(kept * static_cast<double>(squares.size()));
  if (n == 0) return 0.0;
  std::sort(squares.begin(), squares.end());
  return std::accumulate(squares.begin(), squares.begin() + static_cast<std::ptrdiff_t>(n), 0.0) /
         static_cast<double>(n);
}

NoiseLevel friction_wander(ProcessedRecord const& recording, CleanTwin const& twin, RecordPipeline const& pipeline,
                           WanderReading reading, TwinAddress const& address, std::size_t twins,
                           TwinWorkers const& workers) {
  FrictionWander const statistic(recording, pipeline, twin.joint(), reading);
  if (!statistic.is_measurable()) return {};
  NoiseQuestion const question{
      [&](ProcessedRecord const& record) { return statistic(record); },
      [](TwinLoop& loop, double std, double variance_error) {
        loop.friction_wander = std;
        loop.friction_wander_variance_error = variance_error;
      },
      // a random walk of variance s^2 t, less its parabola, has 3/70 of s^2 duration left, half of it below the largest
      // fifth
      [&](double wanted, double none) { return (wanted - none) / (statistic.duration_s() / 47.0); }, always,
      most_wander_in_a_minute / std::sqrt(60.0)};
  return noise_level(question, recording, twin, pipeline, address, twins, workers);
}

}  // namespace torquescope
