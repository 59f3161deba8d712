#include "engine/infer/pipeline/record_pipeline.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "engine/base/contract.hpp"
#include "engine/base/error.hpp"
#include "engine/data/filter_checks.hpp"
#include "engine/data/spline_motion.hpp"
#include "engine/data/zero_phase.hpp"
#include "engine/infer/pipeline/held_torque.hpp"
#include "engine/infer/pipeline/joint_fit.hpp"
#include "engine/infer/pipeline/reversal_mask.hpp"
#include "engine/infer/pipeline/unknown_start.hpp"

namespace torquescope {
namespace {

// the mask at the samples the filter keeps, without the start of the record
std::vector<Eigen::Index> moving_rows(Motion const& motion, ParallelFilter const& filter, double cutoff_hz,
                                      bool with_reversals, std::vector<bool> const& saturated) {
  auto const moving = with_reversals ? samples_without_rest(motion.dq, motion.rate_hz, cutoff_hz)
                                     : moving_samples(motion.dq, motion.rate_hz, cutoff_hz);
  auto const left_out = left_out_samples(motion, cutoff_hz);
  Eigen::VectorXd as_numbers = Eigen::VectorXd::Zero(motion.dq.size());
  for (Eigen::Index k = unknown_start(motion.q, motion.dq); k < as_numbers.size(); ++k)
    if (moving[static_cast<std::size_t>(k)] && !left_out[static_cast<std::size_t>(k)] &&
        (saturated.empty() || !saturated[static_cast<std::size_t>(k)]))
      as_numbers[k] = 1.0;
  Eigen::VectorXd const kept = filter.pick(as_numbers);
  std::vector<Eigen::Index> rows;
  for (Eigen::Index i = 0; i < kept.size(); ++i)
    if (kept[i] == 1.0) rows.push_back(i);
  return rows;
}

// Twice the fastest flank that the catalogue looks for (effects/backlash.cpp): a part that rings or knocks integrates
// what drives it twice, so that noise up there does not matter, and a flank of 100 Hz that is driven up to 60 Hz is
// another one
FilterOptions driving_options(FilterOptions options, double rate_hz) {
  constexpr double per_parallel_cutoff = 6.0, most_of_rate = 0.4;
  double const wide_hz = std::min(per_parallel_cutoff * parallel_cutoff_of(options), most_of_rate * rate_hz);
  if (options.cutoff_hz > 0.0) options.cutoff_hz = std::max(options.cutoff_hz, wide_hz);
  return options;
}

}  // namespace

RecordPipeline::RecordPipeline(JointModel model, FilterOptions const& options, double rate_hz, Eigen::Index n_samples,
                               Section const& filter)
    : model_(std::move(model)),
      options_(options),
      drive_options_(driving_options(options, rate_hz)),
      section_(filter),
      rate_hz_(rate_hz),
      n_samples_(n_samples),
      cutoff_hz_(parallel_cutoff_of(options)),
      filter_(options, rate_hz, n_samples, filter) {}

ProcessedRecord RecordPipeline::process(RecordedMotions motions, std::string const& name) const {
  ProcessedRecord record = prepare(std::move(motions));
  fit(record, name);
  return record;
}

RecordPipeline::SmoothPositions RecordPipeline::smoothed(Eigen::MatrixXd positions) const {
  SmoothPositions smooth;
  if (model_.has_inertia()) smooth.drive = smooth_positions(positions, drive_options_, rate_hz_);
  if (options_.cutoff_hz > 0.0)
    zero_phase_in_place(butterworth_lowpass(static_cast<int>(options_.order), options_.cutoff_hz, rate_hz_), positions);
  smooth.joint = std::move(positions);
  return smooth;
}

std::optional<ProcessedRecord> RecordPipeline::process_smooth(Recording&& recording, SmoothPositions const& positions,
                                                              Eigen::Index column) const {
  std::string const name = recording.name;
  Motion drive;
  if (positions.drive.size() > 0) {
    Recording driving = recording;
    driving.position = positions.drive.col(column);
    drive = spline_motion(std::move(driving));
  }
  recording.position = positions.joint.col(column);
  ProcessedRecord record = prepare(RecordedMotions{differentiate_smooth(std::move(recording)), std::move(drive)});
  if (record.kept_rows.size() <= model_.size()) return std::nullopt;
  fit(record, name);
  return record;
}

// columns of the baseline, and those of effects that this joint has at all: a slide knows no sine of its angle. What
// two waves of the same effect have in common is there once: friction that changes along the travel has one slope
std::vector<Eigen::Index> RecordPipeline::present_columns(Eigen::MatrixXd const& columns) const {
  auto const baseline = static_cast<Eigen::Index>(model_.regressor().size());
  std::vector<Eigen::Index> present;
  for (Eigen::Index k = 0; k < columns.cols(); ++k)
    if (k < baseline || !(columns.col(k).isZero(0.0) || is_repeated(columns, k))) present.push_back(k);
  return present;
}

bool RecordPipeline::is_repeated(Eigen::MatrixXd const& columns, Eigen::Index column) const {
  constexpr double rounding = 1e-9;
  auto const& effects = model_.effects();
  auto const first = [&](std::size_t i) { return static_cast<Eigen::Index>(model_.first_parameter(i)); };
  std::size_t own = 0;
  while (own + 1 < effects.size() && first(own + 1) <= column) ++own;
  for (std::size_t i = 0; i < own; ++i) {
    if (effects[i].effect != effects[own].effect) continue;
    Eigen::Index const other = first(i) + column - first(own);
    if ((columns.col(column) - columns.col(other)).norm() <= rounding * columns.col(column).norm()) return true;
  }
  return false;
}

std::vector<Eigen::Index> RecordPipeline::own_rows(Motion const& motion) const {
  if (!fixed_rows_.empty()) return fixed_rows_;
  return moving_rows(motion, filter_, cutoff_hz_ > 0.0 ? cutoff_hz_ : options_.cutoff_hz, keeps_reversals_, saturated_);
}

std::vector<Eigen::Index> RecordPipeline::all_rows() const {
  std::vector<Eigen::Index> rows(static_cast<std::size_t>(kept_samples()));
  std::iota(rows.begin(), rows.end(), Eigen::Index{0});
  return rows;
}

void RecordPipeline::restrict_to(std::vector<Eigen::Index> kept_rows) {
  fixed_rows_ = std::move(kept_rows);
  if (whitens()) fixed_wander_ = weights_->wander_on(fixed_rows_);
}

void RecordPipeline::weigh_with(std::shared_ptr<NoiseWeights const> weights) {
  weights_ = std::move(weights);
  if (weights_ && weights_->weigh_reversals()) keeps_reversals_ = true;
  if (whitens() && !fixed_rows_.empty()) fixed_wander_ = weights_->wander_on(fixed_rows_);
}

// NOLINTNEXTLINE(performance-unnecessary-value-param): a Ref is a view, and what it looks at is changed
void RecordPipeline::whiten(Eigen::Ref<Eigen::MatrixXd> signals, std::vector<Eigen::Index> const& kept_rows) const {
  if (!whitens()) return;
  if (kept_rows == fixed_rows_) return weights_->apply(signals, kept_rows, fixed_wander_);
  weights_->apply(signals, kept_rows, weights_->wander_on(kept_rows));
}

// NOLINTNEXTLINE(performance-unnecessary-value-param): as above
void RecordPipeline::whiten_rows(Eigen::Ref<Eigen::MatrixXd> signals,
                                 std::vector<Eigen::Index> const& kept_rows) const {
  if (whitens()) weights_->apply_rows(signals, kept_rows);
}

// NOLINTNEXTLINE(performance-unnecessary-value-param): as above
void RecordPipeline::take_shares(Eigen::Ref<Eigen::MatrixXd> signals,
                                 std::vector<Eigen::Index> const& kept_rows) const {
  if (weights_) weights_->take_shares(signals, kept_rows);
}

void RecordPipeline::fit(ProcessedRecord& record, std::string const& name) const {
  require_rows(record.kept_rows.size(), model_.size() + 1, name, fewer_reversals);
  if (whitens()) {
    record.plain_columns = record.columns;
    record.plain_torque = record.torque;
    Eigen::MatrixXd signals(record.columns.rows(), record.columns.cols() + 1);
    signals << record.columns, record.torque;
    whiten(signals, record.kept_rows);
    record.columns = signals.leftCols(record.columns.cols());
    record.torque = signals.col(record.columns.cols());
  }
  fit_joint(record, model_, present_columns(record.columns), name, fit_bounds_);
}

ProcessedRecord RecordPipeline::restricted(ProcessedRecord record, std::vector<Eigen::Index> const& kept_rows,
                                           std::string const& name) const {
  std::vector<Eigen::Index> places;
  std::size_t at = 0;
  for (Eigen::Index row : kept_rows) {
    while (at < record.kept_rows.size() && record.kept_rows[at] < row) ++at;
    TORQUESCOPE_EXPECT(at < record.kept_rows.size() && record.kept_rows[at] == row);
    places.push_back(static_cast<Eigen::Index>(at));
  }
  record.columns = record.columns_themselves()(places, Eigen::all).eval();
  record.torque = record.torque_itself()(places).eval();
  if (record.beside.size() > 0) record.beside = record.beside(places).eval();
  record.kept_rows = kept_rows;
  fit(record, name);
  return record;
}

Motion RecordPipeline::motion_of(Recording const& recording) const {
  return differentiate(recording, options_, section_);
}

ProcessedRecord RecordPipeline::prepare(Recording const& recording) const { return prepare(motions_of(recording)); }

RecordedMotions RecordPipeline::motions_of(Recording const& recording) const {
  Recording driving;
  driving.rate_hz = recording.rate_hz;
  driving.time_s = recording.time_s;
  driving.position = smooth_positions(recording.position, drive_options_, rate_hz_);
  driving.torque = recording.torque;
  return {motion_of(recording), spline_motion(std::move(driving))};
}

ProcessedRecord RecordPipeline::prepare(RecordedMotions&& motions) const {
  TORQUESCOPE_EXPECT(motions.joint->q.size() == n_samples_ && motions.joint->torque.size() == n_samples_);
  ProcessedRecord record;
  record.motion = std::move(motions.joint);
  record.drive = std::move(motions.drive);
  record.kept_rows = own_rows(record.motion);

  // the torque goes through the filter beside the columns: eight signals cost as much as one
  Eigen::MatrixXd signals = model_.columns(record.motion, record.drive);
  Eigen::Index const last = signals.cols();
  signals.conservativeResize(Eigen::NoChange, last + 1);
  signals.col(last) = acting_torque(record.motion->torque);
  signals = filtered_columns(signals, record);
  record.torque = signals.col(last);
  signals.conservativeResize(Eigen::NoChange, last);
  record.columns = std::move(signals);
  if (auto const& load = model_.reference().gear_load) record.beside = filtered(*load, record);
  return record;
}

Eigen::VectorXd RecordPipeline::filtered(Eigen::Ref<Eigen::VectorXd const> const& signal,
                                         ProcessedRecord const& record) const {
  return filter_.apply(signal)(record.kept_rows);
}

Eigen::MatrixXd RecordPipeline::filtered_columns(Eigen::Ref<Eigen::MatrixXd const> const& signals,
                                                 ProcessedRecord const& record) const {
  return filter_.apply_columns(signals)(record.kept_rows, Eigen::all);
}

Eigen::VectorXd RecordPipeline::picked(Eigen::Ref<Eigen::VectorXd const> const& signal,
                                       ProcessedRecord const& record) const {
  return filter_.pick(signal)(record.kept_rows);
}

void require_rows(std::size_t rows, std::size_t wanted, std::string const& name, std::string const& help) {
  validate(rows >= wanted, [&] {
    Problem problem{ExitCode::bad_data,
                    fmt::format("{}: only {} rows are left between reversals, {} are needed", name, rows, wanted)};
    problem.help = help;
    return problem;
  });
}

Eigen::Index guard_rows(RecordPipeline const& pipeline) {
  double const cutoff_hz = pipeline.cutoff_hz();
  return cutoff_hz > 0.0 ? static_cast<Eigen::Index>(std::ceil(3.0 * pipeline.kept_rate_hz() / cutoff_hz)) : 3;
}

}  // namespace torquescope
