#include "engine/infer/moving_rows/recording_evidence.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/base/error.hpp"
#include "engine/base/random_stream.hpp"
#include "engine/effects/carry_over.hpp"
#include "engine/fit/statistics/scaled_solution.hpp"
#include "engine/infer/pipeline/recorded_loop.hpp"
#include "engine/infer/search/own_event.hpp"
#include "engine/infer/search/weights_elsewhere.hpp"

namespace torquescope {
namespace {

bool has_both_directions(Eigen::VectorXd const& velocity) {
  return (velocity.array() > 0.0).any() && (velocity.array() < 0.0).any();
}

// The loop that this recording was made in, with the noise levels of training. A tracking loop that knows the joint
// feeds its friction and gravity forward, which throws a joint whose terms are wrong and large
RecordedLoop loop_in(StageSetting const& setting, ModelStage const& stage, RecordPipeline const& pipeline,
                     Recording const& recording, bool knows_joint) {
  RecordedLoop const& trained = stage.twin->loop;
  TwinJoint const joint = stage.model().twin_joint(stage.parameters());
  TrackedJoint const tracked{joint.lanes.inertia,
                             joint.lanes.viscous,
                             joint.coulomb_forward + joint.offset,
                             joint.coulomb_backward + joint.offset,
                             joint.lanes.gravity_sin,
                             joint.lanes.gravity_cos};
  bool const has_law =
      trained.source != LoopSource::tracking && recording.reference.size() == recording.position.size();
  RecordedLoop loop =
      has_law
          ? recorded_loop(recording, tracked, setting.filter,
                          [&](std::vector<LimitedSample> const&) -> Eigen::VectorXd {
                            ProcessedRecord const record = pipeline.prepare(recording);
                            return pipeline.model().motor_torque(record.motion, record.drive, stage.parameters()).given;
                          })
          : tracking_loop(recording, knows_joint ? tracked : TrackedJoint{tracked.inertia}, setting.filter);
  TwinLoop const& known = trained.loop;
  loop.loop.sticking = known.sticking;
  for (double TwinLoop::*level : {&TwinLoop::disturbance_std, &TwinLoop::disturbance_variance_error,
                                  &TwinLoop::friction_wander, &TwinLoop::friction_wander_variance_error})
    loop.loop.*level = known.*level;
  // noise that was read from what the model leaves, not from a controller's law, is the channel's in every recording
  if (stage.twin->colour) put_colour(*stage.twin->colour, recording.rate_hz, loop.loop);
  return loop;
}

// parameters, one set a row, with those of laws that belong to the training recording alone at zero
Eigen::MatrixXd transferred(JointModel const& model, Eigen::MatrixXd fits) {
  for (std::size_t i = 0; i < model.effects().size(); ++i) {
    Effect const& effect = *model.effects()[i].effect;
    if (!is_clock_bound(effect)) continue;
    fits.middleCols(static_cast<Eigen::Index>(model.first_parameter(i)), static_cast<Eigen::Index>(effect.n_linear()))
        .setZero();
  }
  return fits;
}

// what training's parameters leave, of the recording and of each replicate by those of its own training
Eigen::MatrixXd predicted_signals(ModelStage const& stage, TwinComparison const& here) {
  Eigen::VectorXd const own =
      transferred(stage.model(), stage.comparison.recording.parameters.transpose()).row(0).transpose();
  Eigen::VectorXd const left = here.recording.torque - here.recording.columns * own;
  Eigen::MatrixXd const fits = transferred(stage.model(), stage.comparison.twin_fits);
  Eigen::MatrixXd const twins = here.rows.twins + here.common.columns * (here.twin_fits - fits).transpose();
  return exchangeable(left, twins);
}

// model columns and tangents of its shapes, of laws that predict another recording
Eigen::MatrixXd transferable_columns(JointModel const& model, CandidateColumns const& columns, std::size_t without) {
  Eigen::MatrixXd all = columns.with_tangents();
  auto column = static_cast<Eigen::Index>(model.regressor().size()), tangent = columns.model_columns().cols();
  for (std::size_t i = 0; i < model.effects().size(); ++i) {
    if (i == without) continue;
    Effect const& effect = *model.effects()[i].effect;
    auto const linear = static_cast<Eigen::Index>(effect.n_linear()),
               shapes = static_cast<Eigen::Index>(model.effects()[i].shape.size());
    if (is_clock_bound(effect)) {
      all.middleCols(column, linear).setZero();
      all.middleCols(tangent, shapes).setZero();
    }
    column += linear;
    tangent += shapes;
  }
  return all;
}

// of the record's own offset, on its rows
Eigen::VectorXd offset_direction(ModelStage const& stage, RecordPipeline const& pipeline, TwinComparison const& here) {
  auto const names = stage.model().regressor().names();
  bool const has_offset = std::find(names.begin(), names.end(), "offset") != names.end();
  if (!has_offset) return {};
  Eigen::MatrixXd ones = Eigen::MatrixXd::Ones(here.rows.size(), 1);
  pipeline.whiten(ones, here.rows.kept_rows);
  double const length = ones.norm();
  return length > 0.0 ? Eigen::VectorXd(ones.col(0) / length) : Eigen::VectorXd();
}

// The record's offset, what runs down with the clock (replicates of the record have none: its parameters would be too
// sure), waves per second of any size and phase, and events at instants of their own. left: what training's
// parameters leave
Eigen::MatrixXd own_nuisances(ModelStage const& stage, UnseenEvidence const& of, Eigen::VectorXd left,
                              std::size_t without, std::uint64_t seed) {
  Eigen::MatrixXd own(of.comparison->rows.size(), 0);
  auto const add = [&](Eigen::VectorXd direction) {
    constexpr double nothing_new = 1e-6;
    double const length = direction.norm();
    direction -= own * (own.transpose() * direction).eval();
    if (!(direction.norm() > nothing_new * length)) return;
    own.conservativeResize(Eigen::NoChange, own.cols() + 1);
    own.rightCols(1) = direction.normalized();
    left -= own.rightCols(1) * own.rightCols(1).col(0).dot(left);
  };
  auto const add_all = [&](Eigen::MatrixXd const& columns) {
    for (Eigen::Index k = 0; k < columns.cols(); ++k) add(columns.col(k));
  };
  if (of.offset.size() > 0) add(of.offset);
  Eigen::Index tangent = 0;  // none of effect `without`
  for (std::size_t i = 0; i < stage.model().effects().size(); ++i) {
    auto const& [effect, shape] = stage.model().effects()[i];
    CarryOver const over = carry_over(*effect);
    // an event that is asked for once more is one of this recording, too
    if (over == CarryOver::none) add_all(own_event_columns(of, *effect, left, seed));
    if (i == without) continue;
    bool const is_of_any_size = over == CarryOver::in_part || over == CarryOver::in_frequency;
    if (is_of_any_size) add_all(of.columns->columns(*effect, shape));
    if (over == CarryOver::in_part)
      add_all(of.columns->tangents().middleCols(tangent, static_cast<Eigen::Index>(shape.size())));
    tangent += static_cast<Eigen::Index>(shape.size());
  }
  return own;
}

// what depends on which of the model's effects are nuisances
void fill_signals(ModelStage const& stage, CandidateColumns const& training, std::size_t without, std::uint64_t seed,
                  UnseenEvidence& result) {
  BaselineReference reference = stage.reference();
  reference.gear_load = result.pipeline->model().reference().gear_load;
  reference.given = result.pipeline->model().reference().given;
  result.columns = std::make_shared<CandidateColumns const>(*result.pipeline, *result.comparison, std::move(reference),
                                                            stage.parameters(), without);
  Eigen::MatrixXd signals = predicted_signals(stage, *result.comparison);
  result.own = {};
  result.own = own_nuisances(stage, result, signals.col(0), without, seed);
  // training's orthonormal columns are combinations of the plain ones: the same combinations here
  Eigen::MatrixXd const combination = solve_scaled(training.with_tangents(), training.nuisance());
  result.model = result.without_own(transferable_columns(stage.model(), *result.columns, without));
  result.nuisance = result.model * combination;
  bool const is_asked = without < stage.model().effects().size();
  if (is_asked && !is_clock_bound(*stage.model().effects()[without].effect))
    signals.col(0) += torque_of(stage, *result.columns, without);
  result.signals = result.without_own(std::move(signals));
}

// what is not known of the load that was taken out is drawn anew for every replicate of a prediction
void add_load_errors(Recording const& recording, RandomKey key, RecordPipeline const& pipeline, TwinComparison& here) {
  Eigen::Index const parts = recording.load_errors.cols();
  if (parts == 0) return;
  key.domain = RandomDomain::resampling;
  Eigen::MatrixXd errors = pipeline.filtered_columns(recording.load_errors, here.recording);
  pipeline.whiten(errors, here.rows.kept_rows);
  Eigen::MatrixXd draws(parts, here.rows.n_twins());
  for (Eigen::Index twin = 0; twin < draws.cols(); ++twin) {
    RandomStream stream(key, 0, static_cast<std::uint32_t>(twin));
    for (Eigen::Index k = 0; k < parts; ++k) draws(k, twin) = stream.normal();
  }
  here.rows.twins += errors * draws;
}

UnseenEvidence made(StageSetting const& setting, ModelStage const& stage, CandidateColumns const& training,
                    Recording const& recording, std::uint32_t index, bool knows_joint) {
  auto pipeline = std::make_shared<RecordPipeline>(pipeline_for(setting, recording, stage));
  RecordedLoop const loop = loop_in(setting, stage, *pipeline, recording, knows_joint);
  Eigen::VectorXd const parameters = transferred(stage.model(), stage.parameters().transpose()).row(0).transpose();
  CleanTwin const twin(pipeline->model().twin_joint(parameters), loop.loop, loop.track, stage.twin->twin.step_s());
  weigh_elsewhere(setting, stage, recording, parameters, &loop, index, *pipeline);
  auto const n_twins = static_cast<std::size_t>(stage.comparison.rows.n_twins());
  UnseenEvidence result;
  TwinComparison here = compare_with_twins(recording, twin, *pipeline, {setting.seed, index, first_free_twin_set},
                                           n_twins, setting.workers());
  if (!here.ran_away) add_load_errors(recording, {setting.seed, index}, *pipeline, here);
  here.rows.plain_twins = {};  // as large as all of the rest, and nobody asks
  result.comparison = std::make_shared<TwinComparison const>(std::move(here));
  result.pipeline = pipeline;
  if (result.comparison->ran_away) return result;
  result.offset = offset_direction(stage, *pipeline, *result.comparison);
  result.memory_rows = guard_rows(*pipeline);
  fill_signals(stage, training, CandidateColumns::none, setting.seed, result);
  return result;
}

}  // namespace

Eigen::VectorXd torque_of(ModelStage const& stage, CandidateColumns const& columns, std::size_t i) {
  auto const& effects = stage.model().effects();
  if (i >= effects.size()) return Eigen::VectorXd::Zero(columns.model_columns().rows());
  auto const first = static_cast<Eigen::Index>(stage.model().first_parameter(i));
  return columns.columns(*effects[i].effect, effects[i].shape) *
         stage.parameters().segment(first, static_cast<Eigen::Index>(effects[i].effect->n_linear()));
}

Eigen::MatrixXd exchangeable(Eigen::VectorXd const& left, Eigen::MatrixXd const& twins) {
  auto const m = static_cast<double>(twins.cols());
  Eigen::VectorXd const mean = twins.rowwise().mean();
  Eigen::MatrixXd signals(left.size(), twins.cols() + 1);
  signals.col(0) = left - mean;
  // a replicate is nearer to a mean that it is in than the recording is
  signals.rightCols(twins.cols()) = std::sqrt((m + 1.0) / (m - 1.0)) * (twins.colwise() - mean);
  return signals;
}

Eigen::MatrixXd UnseenEvidence::without_own(Eigen::MatrixXd of) const {
  if (own.cols() > 0) of -= own * (own.transpose() * of).eval();
  return of;
}

std::optional<UnseenEvidence> unseen_evidence(StageSetting const& setting, ModelStage const& stage,
                                              CandidateColumns const& training, Recording const& recording,
                                              std::uint32_t index) {
  try {
    for (bool const knows_joint : {true, false}) {
      UnseenEvidence result = made(setting, stage, training, recording, index, knows_joint);
      if (!result.comparison->ran_away) return result;
    }
    return std::nullopt;
  } catch (Error const&) {
    return std::nullopt;  // too short, or it does not excite a term of the model
  }
}

UnseenResidual unseen_residual(StageSetting const& setting, ModelStage const& stage, Recording const& recording) {
  RecordPipeline pipeline = pipeline_for(setting, recording, stage);
  ProcessedRecord const record = pipeline.prepare(recording);
  Eigen::MatrixXd left =
      record.torque -
      record.columns * transferred(stage.model(), stage.comparison.recording.parameters.transpose()).transpose();
  if (left.rows() == 0) return {};
  if (has_both_directions(pipeline.picked(record.motion->dq, record))) left.array() -= left.mean();
  weigh_elsewhere(setting, stage, recording, stage.parameters(), nullptr, 0, pipeline);
  pipeline.whiten(left, record.kept_rows);
  return {left.squaredNorm(), record.whole_torque().squaredNorm(), left.rows()};
}

Eigen::MatrixXd own_event_columns(UnseenEvidence const& of, Effect const& event, Eigen::VectorXd const& left,
                                  std::uint64_t seed) {
  EventQuestion const question{
      .effect = &event,
      .scales = scales_during(of.columns->scales(), of.comparison->recording.motion->time_s),
      .memory_rows = of.memory_rows,
      .seed = seed};
  auto const columns_at = [&](std::vector<std::vector<double>> const& shapes) {
    auto each = of.columns->columns_of_each(event, shapes);
    for (auto& columns : each) columns = of.without_own(std::move(columns));
    return each;
  };
  auto found = own_event(question, columns_at, left);
  return found ? std::move(found->columns) : Eigen::MatrixXd(left.size(), 0);
}

UnseenEvidence without_effect(UnseenEvidence of, ModelStage const& stage, CandidateColumns const& training,
                              std::size_t without, std::uint64_t seed) {
  fill_signals(stage, training, without, seed, of);
  return of;
}

}  // namespace torquescope
