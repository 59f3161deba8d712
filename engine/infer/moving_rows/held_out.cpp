#include "engine/infer/moving_rows/held_out.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "engine/effects/carry_over.hpp"
#include "engine/fit/statistics/blocked_cv.hpp"
#include "engine/fit/statistics/student_t.hpp"

namespace torquescope {
namespace {

using Rows = std::vector<Eigen::Index>;

// one model on training rows: torque and columns, before whitening
struct PlainRows {
  Eigen::VectorXd torque;
  Eigen::MatrixXd columns;

  // rows: of the stage's own, those that count
  PlainRows(ModelStage const& stage, Rows const& rows) {
    auto const& record = stage.comparison.recording;
    torque = record.torque_itself()(rows);
    columns = record.columns_themselves()(rows, Eigen::all);
    if (!stage.pipeline->keeps_reversals()) return;
    // there the filters leave something of a complete model too
    auto const& twins = stage.comparison.rows.plain_twins;
    if (twins.cols() > 0) torque -= twins.rowwise().mean()(rows);
  }

  // rows near reversals by their shares
  void weigh(RecordPipeline const& pipeline, Rows const& kept_rows) {
    pipeline.take_shares(torque, kept_rows);
    pipeline.take_shares(columns, kept_rows);
  }
};

// both models on the same training rows
struct RowsOfBoth {
  std::optional<PlainRows> before{}, after{};
  Eigen::Index memory_rows;

  explicit RowsOfBoth(Selection const& selection) : memory_rows(guard_rows(*selection.final->pipeline)) {
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
    before.emplace(*selection.baseline, in_one);
    after.emplace(*selection.final, in_other);
    Rows rows;
    for (auto const at : in_other) rows.push_back(final.kept_rows[static_cast<std::size_t>(at)]);
    before->weigh(*selection.final->pipeline, rows);
    after->weigh(*selection.final->pipeline, rows);
  }

  Eigen::VectorXd left(Eigen::VectorXd (*left_out)(Eigen::VectorXd const&, Eigen::MatrixXd const&, Eigen::Index),
                       PlainRows const& rows) const {
    return left_out(rows.torque, rows.columns, memory_rows);
  }
};

// the rows where the laws do something
Rows acting_rows(RowsOfBoth const& rows, ModelStage const& stage) {
  constexpr double something = 0.01;  // of the most they do
  Eigen::ArrayXd torque = Eigen::ArrayXd::Zero(rows.after->torque.size());
  for (std::size_t i = 0; i < stage.model().effects().size(); ++i) {
    auto const first = static_cast<Eigen::Index>(stage.model().first_parameter(i)),
               width = static_cast<Eigen::Index>(stage.model().effects()[i].effect->n_linear());
    torque += (rows.after->columns.middleCols(first, width) * stage.parameters().segment(first, width)).array().abs();
  }
  Rows acting;
  double const least = something * torque.maxCoeff();
  for (Eigen::Index i = 0; i < torque.size(); ++i)
    if (torque[i] > least) acting.push_back(i);
  return acting;
}

HeldOutGain gain_where_acting(RowsOfBoth const& rows, ModelStage const& stage) {
  Rows const acting = acting_rows(rows, stage);
  if (acting.empty()) return {};
  Eigen::VectorXd const before = rows.left(interleaved_residuals, *rows.before)(acting),
                        after = rows.left(interleaved_residuals, *rows.after)(acting);
  return held_out_gain(held_out_blocks(before, after, rows.memory_rows));
}

std::shared_ptr<NoiseWeights const> of_reversals(std::span<std::shared_ptr<NoiseWeights const> const> weights,
                                                 std::size_t i) {
  if (i >= weights.size() || !weights[i] || !weights[i]->weigh_reversals()) return {};
  return std::make_shared<NoiseWeights const>(weights[i]->of_reversals_alone());
}

// of what a complete model leaves of the torque, the energy a row
double noise_of(Selection const& selection) {
  auto const& rows = selection.final->comparison.rows;
  Eigen::MatrixXd twins = rows.plain_twins.size() > 0 ? rows.plain_twins : rows.twins;
  selection.final->pipeline->take_shares(twins, rows.kept_rows);
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

HeldOut held_out_errors(StageSetting const& setting, OtherRecordings const& others, Selection const& selection,
                        std::span<std::shared_ptr<NoiseWeights const> const> weights, Blocks which) {
  HeldOut result;
  std::vector<HeldOutBlock> blocks;
  auto const& unseen = others.unseen;
  auto const add = [&](Eigen::VectorXd const& before, Eigen::VectorXd const& after, Eigen::Index memory_rows) {
    auto const own = held_out_blocks(before, after, memory_rows);
    blocks.insert(blocks.end(), own.begin(), own.end());
    result.left.push_back({after, memory_rows});
  };
  for (std::size_t i = 0; i < unseen.size(); ++i) {
    UnseenResult one =
        check_unseen(unseen[i], setting, *selection.baseline, *selection.final, of_reversals(weights, i));
    result.left_out += one.left_out;
    result.before += one.energies.before;
    result.after += one.energies.after;
    result.torque += one.torque_energy;
    if (one.left_before.size() > 0) add(one.left_before, one.left_after, one.memory_rows);
    result.unseen.push_back(std::move(one));
  }
  if (selection.accepted.empty()) return result;
  RowsOfBoth const rows(selection);
  if (unseen.empty() && others.training.empty())
    add(rows.left(blocked_residuals, *rows.before), rows.left(blocked_residuals, *rows.after), rows.memory_rows);
  if (unseen.empty() && !others.training.empty())
    for (auto const& one : recordings_in_turn(setting, others.training, selection).recordings)
      add(one.before, one.after, one.memory_rows);
  result.gain = held_out_gain(blocks, which);
  result.explained = explained_share(blocks, noise_of(selection));
  bool const all_bound = std::all_of(selection.accepted.begin(), selection.accepted.end(),
                                     [](auto const& one) { return is_clock_bound(*one.effect); });
  if (all_bound) result.acting = gain_where_acting(rows, *selection.final);
  return result;
}

double floor_of(HeldOut const& held_out) {
  double energy = 0.0;
  bool is_known = false;
  for (auto const& one : held_out.unseen) {
    energy += one.floor * one.floor * one.torque_energy;
    is_known = is_known || std::isfinite(one.promised);
  }
  return is_known ? std::sqrt(energy / held_out.torque) : unknown;
}

}  // namespace torquescope
