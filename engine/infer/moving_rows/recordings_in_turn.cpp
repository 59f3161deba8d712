#include "engine/infer/moving_rows/recordings_in_turn.hpp"

#include <algorithm>

#include "engine/effects/carry_over.hpp"
#include "engine/fit/statistics/scaled_solution.hpp"

namespace torquescope {
namespace {

struct FitRows {
  Eigen::VectorXd torque{};
  Eigen::MatrixXd columns{};
};

// of one recording under both models
struct OfRecording {
  FitRows before{}, after{};
  double torque = 0.0;
  Eigen::Index memory_rows = 1;
};

bool has_offset(ModelStage const& stage) {
  auto const names = stage.model().regressor().names();
  return std::find(names.begin(), names.end(), "offset") != names.end();
}

void take_out_offset(FitRows& rows) {
  if (rows.torque.size() == 0) return;
  rows.torque.array() -= rows.torque.mean();
  rows.columns.rowwise() -= rows.columns.colwise().mean().eval();
}

void silence_clocks(JointModel const& model, Eigen::MatrixXd& columns) {
  for (std::size_t i = 0; i < model.effects().size(); ++i) {
    Effect const& effect = *model.effects()[i].effect;
    if (!is_clock_bound(effect)) continue;
    columns
        .middleCols(static_cast<Eigen::Index>(model.first_parameter(i)), static_cast<Eigen::Index>(effect.n_linear()))
        .setZero();
  }
}

OfRecording rows_of(StageSetting const& setting, Recording const& recording, bool is_first,
                    Selection const& selection) {
  RecordPipeline plain = pipeline_for(setting, recording, *selection.baseline),
                 full = pipeline_for(setting, recording, *selection.final);
  ProcessedRecord const before = plain.prepare(recording);
  full.restrict_to(before.kept_rows);
  ProcessedRecord const after = full.prepare(recording);
  OfRecording rows{{before.torque, before.columns},
                   {after.torque, after.columns},
                   before.whole_torque().squaredNorm(),
                   guard_rows(plain)};
  if (!is_first) silence_clocks(full.model(), rows.after.columns);
  if (!has_offset(*selection.baseline)) return rows;
  take_out_offset(rows.before);
  take_out_offset(rows.after);
  return rows;
}

// fit to all recordings but one; without = their number: to all
Eigen::VectorXd fit_to(std::vector<OfRecording> const& all, FitRows OfRecording::*which, std::size_t without) {
  Eigen::Index n = 0;
  for (std::size_t i = 0; i < all.size(); ++i)
    if (i != without) n += (all[i].*which).torque.size();
  FitRows stacked{Eigen::VectorXd(n), Eigen::MatrixXd(n, (all.front().*which).columns.cols())};
  Eigen::Index at = 0;
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (i == without) continue;
    FitRows const& one = all[i].*which;
    stacked.torque.segment(at, one.torque.size()) = one.torque;
    stacked.columns.middleRows(at, one.torque.size()) = one.columns;
    at += one.torque.size();
  }
  return solve_scaled(std::move(stacked.columns), stacked.torque);
}

Eigen::VectorXd left_of(FitRows const& rows, Eigen::VectorXd const& parameters) {
  return rows.torque - rows.columns * parameters;
}

}  // namespace

RecordingsInTurn recordings_in_turn(StageSetting const& setting, std::span<Recording const> further,
                                    Selection const& selection) {
  std::vector<OfRecording> all{rows_of(setting, setting.recording, true, selection)};
  for (auto const& recording : further) all.push_back(rows_of(setting, recording, false, selection));
  Eigen::VectorXd const before = fit_to(all, &OfRecording::before, all.size()),
                        after = fit_to(all, &OfRecording::after, all.size());
  RecordingsInTurn result;
  for (std::size_t i = 0; i < all.size(); ++i) {
    result.recordings.push_back({left_of(all[i].before, fit_to(all, &OfRecording::before, i)),
                                 left_of(all[i].after, fit_to(all, &OfRecording::after, i)), all[i].memory_rows});
    result.torque += all[i].torque;
    result.fitted_before += left_of(all[i].before, before).squaredNorm();
    result.fitted_after += left_of(all[i].after, after).squaredNorm();
  }
  return result;
}

}  // namespace torquescope
