#include "engine/infer/search/model_stage.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>
#include <vector>

#include "engine/base/error.hpp"
#include "engine/fit/statistics/scaled_solution.hpp"
#include "engine/infer/pipeline/joint_bounds.hpp"
#include "engine/infer/pipeline/motion_limits.hpp"
#include "engine/infer/pipeline/reversal_mask.hpp"
#include "engine/infer/replicates/reversal_weights.hpp"
#include "engine/infer/replicates/twin_whitening.hpp"

namespace torquescope {
namespace {

TwinAddress spectrum_set(StageSetting const& setting) { return {setting.seed, 0, first_free_twin_set + 1}; }

TwinAddress reversal_set(StageSetting const& setting) { return {setting.seed, 0, first_free_twin_set + 2}; }

// how a joint is driven through a reversal nobody knows who does not know its controller
bool weighs_reversals(StageSetting const& setting) {
  return setting.reversals == ReversalRows::weigh && !setting.reads_colour &&
         setting.recording.reference.size() == setting.recording.position.size();
}

// plain: masks, weighs nothing; the weights are its own then
NoiseWeights weights_of_rows(StageSetting const& setting, BaselineTwin const& made, RecordPipeline& plain) {
  RowWhitening const rows = twin_whitening(made.twin, plain, spectrum_set(setting), twins_per_round, setting.workers());
  if (!weighs_reversals(setting) || made.colour) return NoiseWeights(rows);
  return reversal_weights(made, plain, rows, reversal_set(setting), twins_per_round, setting.workers());
}

bool has_sizes(JointModel const& model) {
  auto const sizes = sizes_of_effects(model);
  return std::find(sizes.begin(), sizes.end(), true) != sizes.end();
}

// of effects that this joint can have: a column that is not there has no spread over twins
bool is_any_nothing(JointModel const& model, BaselineCorrection const& baseline) {
  auto const sizes = sizes_of_effects(model);
  for (std::size_t k = 0; k < sizes.size(); ++k) {
    auto const at = static_cast<Eigen::Index>(k);
    if (sizes[k] && baseline.parameters[at] <= 0.0 && baseline.std[at] > 0.0) return true;
  }
  return false;
}

// A fit is a statistic from which twins take the bias. Where processing takes more from an effect's column than the
// effect gives, the fit of a right one is negative, and that of its twins the more so: a bound would make all of them 0
// and hide the effect. Where one of them is nothing without the bias, too, all are fitted within their bounds
BaselineTwin twin_of_free_or_bounded_fit(StageSetting const& setting, RecordPipeline& pipeline,
                                         TwinOptions const& options) {
  auto const make = [&] {
    return make_baseline_twin(setting.recording, pipeline, setting.filter, options, setting.workers());
  };
  if (has_sizes(pipeline.model()) && setting.ablation.indirect_inference) {
    pipeline.bound_effects(false);
    try {
      BaselineTwin made = make();
      if (!is_any_nothing(pipeline.model(), made.baseline)) return made;
    } catch (Error const&) {
      // such a fit need be none of a joint that follows
    }
  }
  pipeline.bound_effects(true);
  return make();
}

ModelStage made_stage(StageSetting const& setting, JointModel model) {
  auto pipeline = std::make_unique<RecordPipeline>(pipeline_for(setting, setting.recording, std::move(model)));
  TwinOptions options;
  options.seed = setting.seed;
  options.wander = setting.wander;
  options.reads_colour = setting.reads_colour;
  options.loop = setting.loop;
  options.twins = twins_per_round;
  options.draws_sticking = weighs_reversals(setting);
  auto const make_twin = [&] { return twin_of_free_or_bounded_fit(setting, *pipeline, options); };
  if (setting.weights) pipeline->weigh_with(setting.weights);
  options.levels = setting.levels;
  options.motions = setting.motions ? setting.motions : pipeline->motions_of(setting.recording);
  BaselineTwin made = [&] {
    try {
      return make_twin();
    } catch (Error const&) {
      // the mask may leave too few rows for a first look at a recording that is all reversals
      if (setting.weights || !weighs_reversals(setting)) throw;
      pipeline->keep_reversals();
      return make_twin();
    }
  }();
  if (!setting.weights && setting.ablation.whitening) {
    NoiseWeights const rows = weights_of_rows(setting, made, *pipeline);
    pipeline->weigh_with(std::make_shared<NoiseWeights const>(rows));
    if (pipeline->whitens()) {
      made.friction_wander = measured_wander(setting.recording, made, *pipeline, options, setting.workers());
      pipeline->weigh_with(std::make_shared<NoiseWeights const>(with_wander_of(made, rows, *pipeline)));
      options.loop = std::make_shared<RecordedLoop const>(made.loop);
      options.levels = levels_of(made);
      made = make_twin();
    }
  }
  ablate_twin(made, *pipeline, setting.ablation);
  TwinAddress const null_set{setting.seed, options.recording, first_free_twin_set};
  TwinComparison comparison = compare_with_twins(made.record.motions(), setting.recording.name, made.twin, *pipeline,
                                                 null_set, setting.twins, setting.workers());
  if (!comparison.ran_away) replace_null(comparison, setting.ablation.null, setting.seed, setting.threads);
  ModelStage stage{std::move(pipeline), std::move(made), std::move(comparison), {}};
  if (!stage.comparison.ran_away) stage.energy = mismatch_energy(stage.comparison.rows);
  return stage;
}

}  // namespace

RecordPipeline pipeline_for(StageSetting const& setting, Recording const& recording, JointModel model) {
  bool const is_plain = model.effects().empty();
  model.load_as_in(recording);
  RecordPipeline pipeline(std::move(model), setting.filter, recording.rate_hz, recording.position.size(),
                          setting.filter_section);
  if (setting.inertia_by_turns) pipeline.hold_inertia_by_turns();
  auto saturated = saturated_samples(recording, pipeline.cutoff_hz());
  if (std::find(saturated.begin(), saturated.end(), true) != saturated.end()) pipeline.leave_out(std::move(saturated));
  if (is_plain && setting.least_inertia_share > 0.0) pipeline.hold_inertia_below(setting.least_inertia_share);
  return pipeline;
}

namespace {

void leave_out_new_motion(StageSetting const& setting, Recording const& recording, RecordPipeline& pipeline) {
  if (!setting.trained || &recording == &setting.recording) return;
  std::vector<bool> outside =
      samples_outside(*setting.trained, setting.regressor.columns(pipeline.motion_of(recording)),
                      mask_reach(recording.rate_hz, pipeline.cutoff_hz()));
  auto const saturated = saturated_samples(recording, pipeline.cutoff_hz());
  std::transform(outside.begin(), outside.end(), saturated.begin(), outside.begin(), std::logical_or<>());
  pipeline.leave_out(std::move(outside));
}

}  // namespace

RecordPipeline pipeline_for(StageSetting const& setting, Recording const& recording, ModelStage const& stage) {
  return pipeline_for(setting, recording, stage, stage.model());
}

RecordPipeline pipeline_for(StageSetting const& setting, Recording const& recording, ModelStage const& stage,
                            JointModel model) {
  RecordPipeline pipeline = pipeline_for(setting, recording, std::move(model));
  pipeline.bound_effects(stage.pipeline->bounds_effects());
  leave_out_new_motion(setting, recording, pipeline);
  return pipeline;
}

Eigen::Index judged_rows(StageSetting const& setting, Recording const& recording) {
  RecordPipeline pipeline = pipeline_for(setting, recording, setting.regressor);
  leave_out_new_motion(setting, recording, pipeline);
  return static_cast<Eigen::Index>(pipeline.own_rows(pipeline.motion_of(recording)).size());
}

TrainedMotion trained_motion_of(StageSetting const& setting, std::span<Recording const> further) {
  std::vector<Eigen::MatrixXd> each;
  Eigen::Index rows = 0;
  double memory = 1.0;
  auto const add = [&](Recording const& recording) {
    RecordPipeline const pipeline = pipeline_for(setting, recording, setting.regressor);
    Eigen::MatrixXd const columns = setting.regressor.columns(pipeline.motion_of(recording));
    // without the edges that the filter drops
    Eigen::VectorXd const place =
        pipeline.picked(Eigen::VectorXd::LinSpaced(columns.rows(), 0.0, double(columns.rows() - 1)));
    auto const first = static_cast<Eigen::Index>(place[0]), last = static_cast<Eigen::Index>(place[place.size() - 1]);
    each.push_back(columns.middleRows(first, last + 1 - first));
    rows += each.back().rows();
    memory = static_cast<double>(guard_rows(pipeline)) * pipeline.rate_hz() / pipeline.kept_rate_hz();
  };
  add(setting.recording);
  for (auto const& recording : further) add(recording);
  Eigen::MatrixXd all(rows, each.front().cols());
  Eigen::Index at = 0;
  for (auto const& one : each) {
    all.middleRows(at, one.rows()) = one;
    at += one.rows();
  }
  return trained_motion(all, memory);
}

BaselineReference ModelStage::reference() const {
  auto const& regressor = model().regressor();
  Eigen::VectorXd const own = parameters().head(static_cast<Eigen::Index>(regressor.size()));
  FittedBaseline const baseline =
      fitted_baseline(regressor, {own.data(), regressor.size()}, twin->record.motion,
                      pipeline->cutoff_hz() > 0.0 ? pipeline->cutoff_hz() : 0.4 * pipeline->kept_rate_hz(),
                      twin->loop.loop.encoder_step, model().reference().beside_motion());
  return {baseline.scales, own, model().reference().gear_load, model().reference().given, model().reference().rate_hz};
}

std::optional<ModelStage> make_stage(StageSetting const& setting, JointModel model) {
  bool const is_baseline = model.effects().empty();
  try {
    ModelStage stage = made_stage(setting, std::move(model));
    if (stage.comparison.ran_away) return std::nullopt;
    return stage;
  } catch (Error const&) {
    // a baseline that cannot be fitted or simulated is the recording's fault; with an effect it is the effect's
    if (is_baseline) throw;
    return std::nullopt;
  }
}

std::optional<ModelStage> reweighed_stage(StageSetting const& setting, ModelStage const& stage) {
  StageSetting own = setting;
  own.levels = levels_of(*stage.twin);
  if (stage.pipeline->whitens()) {
    RecordPipeline plain = pipeline_for(setting, setting.recording, stage);
    NoiseWeights const rows = weights_of_rows(setting, *stage.twin, plain);
    own.weights = std::make_shared<NoiseWeights const>(with_wander_of(*stage.twin, rows, plain));
  }
  return make_stage(own, stage.model());
}

bool is_far_too_large(ModelStage const& stage, JointScales const& before) {
  constexpr double far = 2.0;
  auto const& effects = stage.model().effects();
  if (effects.empty()) return false;
  Effect const& effect = *effects.back().effect;
  auto const first = static_cast<Eigen::Index>(stage.model().first_parameter(effects.size() - 1));
  auto const own = effect.linear_bounds(stage.reference().scales), other = effect.linear_bounds(before);
  for (std::size_t k = 0; k < own.size(); ++k) {
    double const most = std::max(own[k].upper, other[k].upper);
    if (most > 0.0 && stage.parameters()[first + static_cast<Eigen::Index>(k)] > far * most) return true;
  }
  return false;
}

double energy_unit_under(ModelStage const& stage, RecordPipeline const& other) {
  auto const& rows = stage.comparison.rows;
  auto const& record = stage.comparison.recording;
  if (!other.whitens() || !record.is_whitened()) return 1.0;
  Eigen::MatrixXd signals(rows.size(), record.plain_columns.cols() + 1);
  signals << record.plain_columns, rows.plain_residual - rows.plain_twins.rowwise().mean();
  other.whiten(signals, rows.kept_rows);
  Eigen::VectorXd const mismatch = signals.rightCols(1);
  Eigen::MatrixXd const columns = signals.leftCols(record.plain_columns.cols());
  double const before = stage.mismatch().squaredNorm();
  double const after = (mismatch - columns * solve_scaled(columns, mismatch)).squaredNorm();
  return before > 0.0 && after > 0.0 ? after / before : 1.0;
}

}  // namespace torquescope
