#include "engine/inference/held_out.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/inference/clock_bound.hpp"
#include "engine/statistics/blocked_cv.hpp"
#include "engine/statistics/student_t.hpp"

namespace torquescope {
namespace {

using Rows = std::vector<Eigen::Index>;

// training rows of both models: torque and columns, before whitening
struct TrainingRows {
  Eigen::VectorXd torque;
  Eigen::MatrixXd before, after;
  Eigen::Index memory_rows;

  explicit TrainingRows(Selection const& selection) : memory_rows(guard_rows(*selection.final->pipeline)) {
    auto const& baseline = selection.baseline->comparison.recording;
    auto const& final = selection.final->comparison.recording;
    Rows in_one, in_other;
    for (std::size_t i = 0, k = 0; i < baseline.kept_rows.size() && k < final.kept_rows.size();) {
      auto const one = baseline.kept_rows[i], other = final.kept_rows[k];
      if (one == other) {
        in_one.push_back(static_cast<Eigen::Index>(i));
        in_other.push_back(static_cast<Eigen::Index>(k));
      }
      if (one <= other) ++i;
      if (one >= other) ++k;
    }
    torque = final.torque_itself()(in_other);
    before = baseline.columns_themselves()(in_one, Eigen::all);
    after = final.columns_themselves()(in_other, Eigen::all);
  }
};

// the rows where the laws do something
Rows acting_rows(TrainingRows const& rows, ModelStage const& stage) {
  constexpr double something = 0.01;  // of the most they do
  Eigen::ArrayXd torque = Eigen::ArrayXd::Zero(rows.torque.size());
  for (std::size_t i = 0; i < stage.model().effects().size(); ++i) {
    auto const first = static_cast<Eigen::Index>(stage.model().first_parameter(i)),
               width = static_cast<Eigen::Index>(stage.model().effects()[i].effect->n_linear());
    torque += (rows.after.middleCols(first, width) * stage.parameters().segment(first, width)).array().abs();
  }
  Rows acting;
  double const least = something * torque.maxCoeff();
  for (Eigen::Index i = 0; i < torque.size(); ++i)
    if (torque[i] > least) acting.push_back(i);
  return acting;
}

HeldOutGain gain_where_acting(TrainingRows const& rows, ModelStage const& stage) {
  Rows const acting = acting_rows(rows, stage);
  if (acting.empty()) return {};
  Eigen::VectorXd const before = interleaved_residuals(rows.torque, rows.before, rows.memory_rows)(acting),
                        after = interleaved_residuals(rows.torque, rows.after, rows.memory_rows)(acting);
  return held_out_gain(held_out_blocks(before, after, rows.memory_rows));
}

// of what a complete model leaves of the torque, the energy a row
double noise_of(Selection const& selection) {
  auto const& rows = selection.final->comparison.rows;
  auto const& twins = rows.plain_twins.size() > 0 ? rows.plain_twins : rows.twins;
  return twins.squaredNorm() / static_cast<double>(twins.size());
}

}  // namespace

ExplainedShare explained_share(std::span<HeldOutBlock const> blocks, double noise) {
  ExplainedShare result;
  double before = 0.0, after = 0.0;
  for (auto const& block : blocks) {
    before += std::max(0.0, block.before - noise * block.rows);
    after += std::max(0.0, block.after - noise * block.rows);
  }
  auto const n = static_cast<double>(blocks.size());
  if (!(before > 0.0) || blocks.size() < 5) return result;
  result.share = 1.0 - after / before;
  double squares = 0.0;
  for (auto const& block : blocks) {
    double const b = before - std::max(0.0, block.before - noise * block.rows),
                 a = after - std::max(0.0, block.after - noise * block.rows);
    double const without = b > 0.0 ? 1.0 - a / b : result.share;
    squares += (without - result.share) * (without - result.share);
  }
  double const error = std::sqrt((n - 1.0) / n * squares);
  double const half = student_t_quantile(1.959964, n - 1.0) * error;
  result.low = result.share - half;
  result.high = std::min(1.0, result.share + half);
  return result;
}

HeldOut held_out_errors(StageSetting const& setting, std::span<Recording const> unseen, Selection const& selection) {
  HeldOut result;
  std::vector<HeldOutBlock> blocks;
  for (auto const& recording : unseen) {
    UnseenResult one = check_unseen(recording, setting, *selection.baseline, *selection.final);
    result.left_out += one.left_out;
    result.before += one.energies.before;
    result.after += one.energies.after;
    result.torque += one.torque_energy;
    if (one.left_before.size() > 0) {
      auto const own = held_out_blocks(one.left_before, one.left_after, one.memory_rows);
      blocks.insert(blocks.end(), own.begin(), own.end());
    }
    result.unseen.push_back(std::move(one));
  }
  if (selection.accepted.empty()) return result;
  TrainingRows const rows(selection);
  if (unseen.empty())
    blocks = held_out_blocks(blocked_residuals(rows.torque, rows.before, rows.memory_rows),
                             blocked_residuals(rows.torque, rows.after, rows.memory_rows), rows.memory_rows);
  result.gain = held_out_gain(blocks);
  result.explained = explained_share(blocks, noise_of(selection));
  bool const all_bound = std::all_of(selection.accepted.begin(), selection.accepted.end(),
                                     [](auto const& one) { return is_clock_bound(*one.effect); });
  if (all_bound) result.acting = gain_where_acting(rows, *selection.final);
  return result;
}

}  // namespace torquescope
