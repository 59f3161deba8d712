#include "engine/diagnose/column_export.hpp"

#include <algorithm>
#include <memory>
#include <utility>

#include "engine/base/parallel.hpp"
#include "engine/data/encoder_step.hpp"
#include "engine/infer/pipeline/simulator_gap.hpp"
#include "engine/infer/search/shape_refinement.hpp"
#include "engine/infer/validation/unseen_record.hpp"

namespace torquescope {
namespace {

double smoothing_cutoff(RecordPipeline const& pipeline) {
  return pipeline.cutoff_hz() > 0.0 ? pipeline.cutoff_hz() : 0.4 * pipeline.kept_rate_hz();
}

// a recording compared with itself: candidates see its own motion, and no replicate takes chance off what they explain
TwinComparison by_itself(RecordPipeline const& pipeline, ProcessedRecord record) {
  TwinComparison result;
  auto& rows = result.rows;
  rows.rate_hz = pipeline.kept_rate_hz();
  rows.kept_rows = record.kept_rows;
  auto const pick = [&](Eigen::VectorXd const& signal) { return pipeline.picked(signal, record); };
  rows.time_s = pick(record.motion->time_s);
  rows.q = pick(record.motion->q);
  rows.dq = pick(record.motion->dq);
  rows.ddq = pick(record.motion->ddq);
  rows.torque = record.torque;
  rows.residual = record.residual;
  Eigen::Index const n = record.torque.size();
  rows.twin_mean = Eigen::VectorXd::Zero(n);
  rows.twins = Eigen::MatrixXd::Zero(n, 2);
  result.common = std::move(record);
  return result;
}

// one recording with all that its columns look into; stays where it is made
struct MeasuredRecord {
  MeasuredRecord(RecordPipeline&& made_pipeline, ProcessedRecord record, BaselineReference const& reference)
      : pipeline(std::move(made_pipeline)),
        comparison(by_itself(pipeline, std::move(record))),
        columns(pipeline, comparison, reference, reference.parameters) {}
  MeasuredRecord(MeasuredRecord const&) = delete;
  MeasuredRecord& operator=(MeasuredRecord const&) = delete;

  RecordColumns all_columns(std::string name, std::vector<ShapedCandidate> const& candidates, int threads) const {
    auto const& rows = comparison.rows;
    RecordColumns result{
        std::move(name), rows.rate_hz, pipeline.cutoff_hz(), rows.kept_rows,           rows.time_s, rows.q,
        rows.dq,         rows.ddq,     rows.torque,          comparison.common.columns};
    result.candidates.resize(candidates.size());
    parallel_for(candidates.size(), threads, [&](std::size_t i, int) {
      result.candidates[i] = columns.columns(*candidates[i].effect, candidates[i].shape);
    });
    return result;
  }

  RecordPipeline pipeline;
  TwinComparison comparison;
  CandidateColumns columns;
};

RecordPipeline pipeline_of(DiagnosisInput const& input, Recording const& recording) {
  return {input.regressor, input.filter, recording.rate_hz, recording.position.size(), input.filter_section};
}

// the grid point that explains most; is_testable stays false when none explains anything
EffectScan best_on_grid(CandidateColumns const& columns, Effect const& effect, int threads) {
  constexpr std::size_t points_at_once = 16;
  EffectScan scan;
  scan.effect = &effect;
  scan.grid = shape_grid(effect, columns.scales());
  Eigen::VectorXd const& residual = columns.comparison().rows.residual;
  std::vector<double> gains(scan.grid.size(), 0.0);
  parallel_for((gains.size() + points_at_once - 1) / points_at_once, threads, [&](std::size_t slice, int) {
    std::size_t const first = slice * points_at_once, last = std::min(gains.size(), first + points_at_once);
    std::vector<std::vector<double>> shapes;
    for (std::size_t i = first; i < last; ++i) shapes.push_back(scan.grid.point(i));
    auto const groups = columns.groups(effect, shapes);
    for (std::size_t i = first; i < last; ++i) {
      auto const& group = groups[i - first];
      if (group.rank() > 0) gains[i] = bounded_gain(group, group.q.transpose() * residual).gain;
    }
  });
  auto const best = std::max_element(gains.begin(), gains.end());
  scan.is_testable = *best > 0.0;
  scan.best_point = static_cast<std::size_t>(best - gains.begin());
  scan.shape = scan.grid.point(scan.best_point);
  return scan;
}

void shape_candidates(ColumnExport& result, CandidateColumns const& columns, DiagnosisInput const& input) {
  ShapeSearch const search = shape_search(input.selection.shape_optimiser, input.seed);
  for (Effect const* effect : input.selection.candidates) {
    if (!effect->exists_on(columns.joint())) continue;
    EffectScan const scan = best_on_grid(columns, *effect, input.threads);
    if (!scan.is_testable) {
      result.not_testable.push_back(effect);
      continue;
    }
    RefinedEffect refined = refine_shape(columns, scan, columns.comparison().rows.residual, search, input.threads);
    result.candidates.push_back({effect, std::move(refined.shape), scan.grid.size(), refined.gain});
  }
}

}  // namespace

ColumnExport export_columns(DiagnosisInput const& input) {
  Recording train = from_zero(input.train);
  RecordPipeline pipeline = pipeline_of(input, train);
  Eigen::VectorXd simulator_parameters;
  if (train.simulated_torque.size() > 0) {
    SimulatorGap gap = gap_to_simulator(train, pipeline);
    simulator_parameters = std::move(gap.simulator_parameters);
    train = std::move(gap.recording);
  }
  ProcessedRecord record = pipeline.process(train);
  auto const size = input.regressor.size();
  BaselineReference reference{.parameters = record.parameters, .gear_load = gear_load_of(train)};
  reference.scales = fitted_baseline(input.regressor, {record.parameters.data(), size}, record.motion,
                                     smoothing_cutoff(pipeline), encoder_step(train), reference.beside_motion())
                         .scales;
  ColumnExport result;
  {
    MeasuredRecord const measured(std::move(pipeline), std::move(record), reference);
    shape_candidates(result, measured.columns, input);
    result.train = measured.all_columns(train.name, result.candidates, input.threads);
  }
  for (auto const& given : input.validate) {
    Recording unseen = from_zero(given);
    RecordPipeline own = pipeline_of(input, unseen);
    if (simulator_parameters.size() > 0) unseen = without_simulator(std::move(unseen), own, simulator_parameters);
    reference.gear_load = gear_load_of(unseen);
    ProcessedRecord prepared = own.prepare(unseen);
    MeasuredRecord const measured(std::move(own), std::move(prepared), reference);
    result.validate.push_back(measured.all_columns(unseen.name, result.candidates, input.threads));
  }
  return result;
}

}  // namespace torquescope
