#include "engine/infer/pipeline/record_pipeline.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "engine/base/contract.hpp"
#include "engine/base/error.hpp"
#include "engine/data/filter_checks.hpp"
#include "engine/infer/pipeline/held_torque.hpp"
#include "engine/infer/pipeline/joint_fit.hpp"
#include "engine/infer/pipeline/reversal_mask.hpp"
#include "engine/infer/pipeline/unknown_start.hpp"

namespace torquescope {

RecordPipeline::RecordPipeline(JointModel model, FilterOptions const& options, double rate_hz, Eigen::Index n_samples,
                               Section const& filter)
    : model_(std::move(model)),
      options_(options),
      section_(filter),
      rate_hz_(rate_hz),
      n_samples_(n_samples),
      cutoff_hz_(parallel_cutoff_of(options)),
      filter_(options, rate_hz, n_samples, filter) {}

// the mask at the samples the filter keeps, without the start of the record
std::vector<Eigen::Index> RecordPipeline::own_rows(Motion const& motion) const {
  double const cutoff_hz = cutoff_hz_ > 0.0 ? cutoff_hz_ : options_.cutoff_hz;
  auto const moving = moving_samples(motion.dq, motion.rate_hz, cutoff_hz);
  auto const left_out = left_out_samples(motion, cutoff_hz);
  Eigen::VectorXd as_numbers = Eigen::VectorXd::Zero(motion.dq.size());
  for (Eigen::Index k = unknown_start(motion.q, motion.dq); k < as_numbers.size(); ++k)
    if (moving[static_cast<std::size_t>(k)] && !left_out[static_cast<std::size_t>(k)]) as_numbers[k] = 1.0;
  Eigen::VectorXd const kept = filter_.pick(as_numbers);
  std::vector<Eigen::Index> rows;
  for (Eigen::Index i = 0; i < kept.size(); ++i)
    if (kept[i] == 1.0) rows.push_back(i);
  return rows;
}

ProcessedRecord RecordPipeline::process(Recording const& recording) const {
  ProcessedRecord record = prepare(recording);
  require_rows(record.kept_rows.size(), model_.size() + 1, recording.name, fewer_reversals);
  fit_joint(record, model_, recording.name);
  return record;
}

Motion RecordPipeline::motion_of(Recording const& recording) const {
  return differentiate(recording, options_, section_);
}

ProcessedRecord RecordPipeline::prepare(Recording const& recording) const {
  ProcessedRecord record;
  record.motion = motion_of(recording);
  TORQUESCOPE_EXPECT(record.motion.q.size() == n_samples_ && record.motion.torque.size() == n_samples_);
  record.kept_rows = own_rows(record.motion);
  // the torque goes through the filter beside the columns: eight signals cost as much as one
  Eigen::MatrixXd signals = model_.columns(record.motion, record.motion);
  Eigen::Index const last = signals.cols();
  signals.conservativeResize(Eigen::NoChange, last + 1);
  signals.col(last) = acting_torque(record.motion.torque);
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
