#include "engine/unseen/held_out_judgement.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "engine/statistics/blocked_cv.hpp"
#include "engine/unseen/unseen_nuisances.hpp"
#include "engine/unseen/unseen_refutation.hpp"
#include "engine/unseen/unseen_transfer.hpp"

namespace torquescope {
namespace {

using Rows = std::vector<Eigen::Index>;

struct CommonRows {
  Rows rows{}, in_one{}, in_other{};
};

// both sorted
CommonRows common_rows(Rows const& one, Rows const& other) {
  CommonRows common;
  for (std::size_t i = 0, k = 0; i < one.size() && k < other.size();) {
    if (one[i] == other[k]) {
      common.rows.push_back(one[i]);
      common.in_one.push_back(static_cast<Eigen::Index>(i));
      common.in_other.push_back(static_cast<Eigen::Index>(k));
    }
    bool const is_before = one[i] <= other[k], is_behind = one[i] >= other[k];
    if (is_before) ++i;
    if (is_behind) ++k;
  }
  return common;
}

// training rows of both models: torque and columns, before whitening
struct TrainingRows {
  CommonRows common;
  Eigen::VectorXd torque;
  Eigen::MatrixXd before, after;
  Eigen::Index memory_rows;

  explicit TrainingRows(Selection const& selection) : memory_rows(guard_rows(*selection.final->pipeline)) {
    auto const& baseline = selection.baseline->comparison.recording;
    auto const& final = selection.final->comparison.recording;
    common = common_rows(baseline.kept_rows, final.kept_rows);
    torque = final.torque_itself()(common.in_other);
    before = baseline.columns_themselves()(common.in_one, Eigen::all);
    after = final.columns_themselves()(common.in_other, Eigen::all);
  }
};

struct ColumnsOf {
  Eigen::Index first, width;
};

ColumnsOf columns_of(ModelStage const& stage, std::size_t effect) {
  return {static_cast<Eigen::Index>(stage.model().first_parameter(effect)),
          static_cast<Eigen::Index>(stage.model().effects()[effect].effect->n_linear())};
}

HeldOutResiduals cross_validated(TrainingRows const& rows) {
  return {rows.common.rows, blocked_residuals(rows.torque, rows.before, rows.memory_rows),
          blocked_residuals(rows.torque, rows.after, rows.memory_rows), rows.memory_rows};
}

// the rows where the effects do something
Rows acting_rows(TrainingRows const& rows, ModelStage const& stage) {
  constexpr double something = 0.01;  // of the most they do
  Eigen::ArrayXd torque = Eigen::ArrayXd::Zero(rows.torque.size());
  for (std::size_t i = 0; i < stage.model().effects().size(); ++i) {
    auto const [first, width] = columns_of(stage, i);
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

HeldOutGain gain_of(std::vector<HeldOutResiduals> const& residuals) {
  std::vector<HeldOutBlock> blocks;
  for (auto const& one : residuals) {
    if (one.before.size() == 0) continue;
    auto const own = held_out_blocks(one.before, one.after, one.memory_rows);
    blocks.insert(blocks.end(), own.begin(), own.end());
  }
  return held_out_gain(blocks);
}

// what held-out rows lose without each effect. Not by what it moves there: beside a law that throws the prediction off,
// whatever little another one moves would look worse
std::vector<double> worth_unseen(std::vector<UnseenResult> const& unseen, std::size_t n_effects) {
  std::vector<double> worth(n_effects, 0.0);
  for (auto const& result : unseen)
    for (std::size_t i = 0; i < result.by_effect.size(); ++i) worth[i] += result.by_effect[i].gain();
  return worth;
}

std::vector<double> worth_in_blocks(TrainingRows const& rows, ModelStage const& stage) {
  Eigen::VectorXd const with = blocked_residuals(rows.torque, rows.after, rows.memory_rows);
  std::vector<double> worth;
  for (std::size_t i = 0; i < stage.model().effects().size(); ++i) {
    auto const [first, width] = columns_of(stage, i);
    Eigen::MatrixXd others(rows.after.rows(), rows.after.cols() - width);
    others << rows.after.leftCols(first), rows.after.rightCols(rows.after.cols() - first - width);
    worth.push_back(blocked_residuals(rows.torque, others, rows.memory_rows).squaredNorm() - with.squaredNorm());
  }
  return worth;
}

void check_each(HeldOutJudgement& judgement, StageSetting const& setting, std::span<Recording const> unseen,
                Selection const& selection) {
  UnseenSum sum;
  for (auto const& recording : unseen) {
    UnseenResult result = check_unseen(recording, setting, *selection.baseline, *selection.final);
    sum.add(result);
    judgement.left_out += result.left_out;
    judgement.twins_ran_away = judgement.twins_ran_away || result.twins_ran_away;
    double const relerr = std::sqrt(result.energies.after / result.torque_energy);
    if (auto beyond = beyond_twins(recording.name, relerr, result.transferred))
      judgement.beyond.push_back(std::move(*beyond));
    judgement.residuals.push_back({result.kept_rows, result.left_before, result.left_after, result.memory_rows});
    judgement.unseen.push_back(std::move(result));
  }
  judgement.energies = sum.energies();
  judgement.torque_energy = sum.torque_energy();
}

}  // namespace

HeldOutRefusal refusal_of(HeldOutEvidence const& evidence) {
  if (evidence.has_bound && !evidence.is_adequate) return HeldOutRefusal::bound_to_instant;
  if (evidence.is_spoken_against) return HeldOutRefusal::spoils_unseen;
  if (evidence.gain.change == HeldOutChange::lower) return HeldOutRefusal::none;
  bool const holds_where_it_acts =
      evidence.all_bound && evidence.gain.is_not_worse() && evidence.acting.change == HeldOutChange::lower;
  return holds_where_it_acts ? HeldOutRefusal::none : HeldOutRefusal::not_lower;
}

std::vector<std::size_t> spoilers_of(HeldOutRefusal refusal, std::vector<double> const& worth,
                                     std::vector<std::size_t> bound) {
  bool const leaves_bound = refusal == HeldOutRefusal::bound_to_instant;
  std::vector<std::size_t> spoilers = leaves_bound ? std::move(bound) : std::vector<std::size_t>{};
  std::optional<std::size_t> worst;
  for (std::size_t i = 0; i < worth.size(); ++i) {
    bool const is_going = std::find(spoilers.begin(), spoilers.end(), i) != spoilers.end();
    if (!is_going && (!worst || worth[i] < worth[*worst])) worst = i;
  }
  // beside laws of an instant, which spoil what is beside them, only a law that does so itself
  if (worst && (!leaves_bound || worth[*worst] < 0.0)) spoilers.push_back(*worst);
  return spoilers;
}

HeldOutJudgement judge_held_out(StageSetting const& setting, std::span<Recording const> unseen,
                                Selection const& selection, Remainder const& remainder) {
  HeldOutJudgement judgement;
  check_each(judgement, setting, unseen, selection);
  judgement.is_adequate = !remainder.is_significant && judgement.beyond.empty();
  if (selection.accepted.empty()) return judgement;

  HeldOutEvidence evidence;
  std::vector<std::size_t> bound;
  for (std::size_t i = 0; i < selection.accepted.size(); ++i)
    if (!predicts_elsewhere(*selection.accepted[i].effect)) bound.push_back(i);
  evidence.has_bound = !bound.empty();
  evidence.all_bound = bound.size() == selection.accepted.size();
  evidence.is_adequate = judgement.is_adequate;
  TrainingRows const rows(selection);
  if (unseen.empty()) judgement.residuals.push_back(cross_validated(rows));
  evidence.gain = judgement.gain = gain_of(judgement.residuals);
  if (evidence.all_bound) evidence.acting = judgement.acting = gain_where_acting(rows, *selection.final);
  if (!unseen.empty()) {
    judgement.are_a_part = !remainder.is_named_enough && !judgement.beyond.empty();
    evidence.is_spoken_against =
        judgement.are_a_part ? speak_against_a_part(judgement.energies) : speak_against(judgement.energies);
  }
  judgement.refusal = refusal_of(evidence);
  if (judgement.holds()) return judgement;
  auto const worth = unseen.empty() ? worth_in_blocks(rows, *selection.final)
                                    : worth_unseen(judgement.unseen, selection.accepted.size());
  judgement.spoilers = spoilers_of(judgement.refusal, worth, std::move(bound));
  return judgement;
}

HeldOutGain gain_over(HeldOutJudgement const& one, HeldOutJudgement const& other) {
  std::vector<HeldOutResiduals> both;
  for (std::size_t i = 0; i < std::min(one.residuals.size(), other.residuals.size()); ++i) {
    auto const& a = one.residuals[i];
    auto const& b = other.residuals[i];
    CommonRows const common = common_rows(a.rows, b.rows);
    if (common.rows.empty()) continue;
    both.push_back({common.rows, a.after(common.in_one), b.after(common.in_other), a.memory_rows});
  }
  return gain_of(both);
}

}  // namespace torquescope
