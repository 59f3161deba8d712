#include "engine/infer/validation/unseen_record.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "engine/base/error.hpp"
#include "engine/fit/statistics/scaled_solution.hpp"
#include "engine/infer/pipeline/held_torque.hpp"
#include "engine/infer/validation/unseen_floor.hpp"
#include "engine/infer/validation/unseen_nuisances.hpp"

namespace torquescope {
namespace {

void check_rows(ProcessedRecord const& record, std::string const& name) {
  require_rows(record.kept_rows.size(), static_cast<std::size_t>(fewest_rows), name,
               "give a longer recording as validate, or none");
}

// the loop that another recording was made in, without levels; none where twins follow a measured motion
std::optional<RecordedLoop> loop_of(Recording const& recording, StageSetting const& setting, ModelStage const& stage) {
  if (stage.twin->loop.source == LoopSource::tracking || recording.reference.size() != recording.position.size())
    return std::nullopt;
  return recorded_loop(recording, {}, {}, [&](std::vector<LimitedSample> const&) -> Eigen::VectorXd {
    RecordPipeline const pipeline = pipeline_for(setting, recording, stage);
    ProcessedRecord const record = pipeline.prepare(recording);
    Eigen::VectorXd const parameters = transferable(stage);  // an event of the training recording is none here
    return pipeline.model().motor_torque(record.motion, record.drive, parameters).given;
  });
}

double position_error(Recording const& recording, RecordedLoop const& loop, ModelStage const& stage,
                      ModelElsewhere there) {
  there.model.load_as_in(recording);
  CleanTwin const twin(there.model.twin_joint(there.parameters), noiseless(loop.loop), loop.track,
                       stage.twin->twin.step_s());
  TwinGroup group;
  twin.simulate({}, 0, group);
  if (group.ran_away[0]) return unknown;
  return std::sqrt((group.position[0] - recording.position).squaredNorm() /
                   static_cast<double>(recording.position.size()));
}

// what its twins leave, and whether that is a floor of it
void account_for_twins(Recording const& recording, StageSetting const& setting, ModelStage const& stage,
                       RecordedLoop const& loop, std::shared_ptr<NoiseWeights const> const& weights,
                       UnseenResult& result) {
  TwinRows rows;
  if (!result.rows.empty()) rows = {&result.rows, true, weights};
  auto const errors_in = [&](RecordedLoop const& one) {
    return unseen_twin_errors(recording, setting, stage, one, rows);
  };
  TwinErrors const own = errors_in(loop);
  result.promised = own.mean;
  result.twins_ran_away = !std::isfinite(own.mean);
  double const relerr = std::sqrt(result.energies.after / result.torque_energy);
  result.floor = floor_below(relerr, own);
  RecordedLoop const& trained = stage.twin->loop;
  if (std::isfinite(result.floor) || result.twins_ran_away || trained.track.rate_hz != loop.track.rate_hz) return;
  result.floor = floor_below(relerr, errors_in(with_law_of(trained, loop)));
}

// what processing alone leaves of a complete model on given rows; empty: not known
using Artefact = std::function<Eigen::VectorXd(ModelStage const& model, std::vector<Eigen::Index> const& rows)>;

// of both models, on the same rows; none where that of one is not known
struct Artefacts {
  Eigen::VectorXd before{}, after{};

  Artefacts(Artefact const& artefact, ModelStage const& baseline, ModelStage const& augmented,
            std::vector<Eigen::Index> const& rows) {
    if (!artefact) return;
    before = artefact(baseline, rows);
    after = artefact(augmented, rows);
    if (before.size() == 0 || after.size() == 0) before = after = {};
  }
  bool are_known() const { return after.size() > 0; }
};

void take_out(Eigen::VectorXd const& artefact, Eigen::VectorXd& left) {
  if (artefact.size() > 0) left -= artefact;
}

// rows counting for as much as their shares say
double weighed_energy(Eigen::VectorXd const& left, Eigen::VectorXd const& shares) {
  return left.cwiseProduct(shares).squaredNorm();
}

PredictionEnergies energies_of(Eigen::VectorXd const& before, Eigen::VectorXd const& after,
                               Eigen::VectorXd const& shares) {
  return {weighed_energy(before, shares), weighed_energy(after, shares), weighed_energy(before - after, shares)};
}

// with the artefact of the final model, which that effect changes little
PredictionEnergies without_effect(ModelStage const& augmented, std::size_t effect, ProcessedRecord const& after,
                                  Eigen::VectorXd const& parameters, Eigen::VectorXd const& left_with,
                                  Eigen::VectorXd const& artefact, Eigen::VectorXd const& shares) {
  auto const first = static_cast<Eigen::Index>(augmented.model().first_parameter(effect));
  auto const width = static_cast<Eigen::Index>(augmented.model().effects()[effect].effect->n_linear());
  // what the other terms would have been fitted to without it: they take its torque up as far as they can
  Eigen::MatrixXd const& trained = augmented.comparison.recording.columns;
  std::vector<Eigen::Index> others;
  for (Eigen::Index k = 0; k < trained.cols(); ++k)
    if (k < first || k >= first + width) others.push_back(k);
  Eigen::VectorXd const torque = trained.middleCols(first, width) * augmented.estimate().segment(first, width);
  Eigen::VectorXd const refitted = parameters(others) + solve_scaled(trained(Eigen::all, others), torque);
  Eigen::VectorXd left = after.torque - after.columns(Eigen::all, others) * refitted;
  take_out(artefact, left);
  return energies_of(left, left_with, shares);
}

struct Predictor {
  ModelStage const& stage;
  ModelElsewhere there;
  double offset;

  // on every kept sample
  Eigen::VectorXd left(ProcessedRecord const& record) const {
    return ((record.torque - record.columns * there.parameters).array() - offset).matrix();
  }
};

LeftOutRows left_out_of(Recording const& recording, StageSetting const& setting, Predictor const& before,
                        Predictor const& after, std::vector<Eigen::Index> const& kept_rows) {
  auto const on_all_rows = [&](Predictor const& by) {
    RecordPipeline pipeline = pipeline_for(setting, recording, by.stage, by.there.model);
    pipeline.restrict_to(pipeline.all_rows());
    return pipeline.prepare(recording);
  };
  ProcessedRecord const whole_before = on_all_rows(before), whole_after = on_all_rows(after);
  return left_out_rows(whole_before.whole_torque(), before.left(whole_before), after.left(whole_after), kept_rows);
}

UnseenPrediction predict(Recording const& recording, StageSetting const& setting, ModelStage const& baseline,
                         ModelStage const& augmented, Artefact const& artefact,
                         std::shared_ptr<NoiseWeights const> const& weights) {
  UnseenPrediction result;
  RecordPipeline plain = pipeline_for(setting, recording, baseline);
  RecordPipeline full = pipeline_for(setting, recording, augmented);
  plain.weigh_with(weights);
  ProcessedRecord before = plain.prepare(recording);
  check_rows(before, recording.name);
  full.restrict_to(before.kept_rows);
  ProcessedRecord after = full.prepare(recording);
  Eigen::VectorXd begun = transferable(augmented);
  refit_on_head(augmented, after, begun, result.nuisances);
  result.there = with_own_events(augmented, full, after, {augmented.model(), begun}, setting.seed, result.nuisances);
  Eigen::VectorXd const& parameters = result.there->parameters;
  if (parameters != begun) {
    RecordPipeline there = pipeline_for(setting, recording, augmented, result.there->model);
    there.restrict_to(before.kept_rows);
    after = there.prepare(recording);
  }
  Eigen::VectorXd left_before = before.torque - before.columns * baseline.estimate();
  Eigen::VectorXd left_after = after.torque - after.columns * parameters;
  Artefacts const artefacts(artefact, baseline, augmented, before.kept_rows);
  take_out(artefacts.before, left_before);
  take_out(artefacts.after, left_after);
  if (artefacts.are_known()) {
    result.rows = before.kept_rows;
    result.nuisances.push_back(
        "what the filters make of reversals, as replicates have it, taken out of both residuals");
  }
  Eigen::VectorXd const left_with = left_after;
  double offset_before = 0.0, offset_after = 0.0;
  Eigen::VectorXd const velocity = plain.picked(before.motion->dq, before);
  if (augmented.model().effects().empty()) {
    left_after = left_before;  // one model: nothing to compare, nothing to refit
  } else if (double const offset = head_offset(left_after, velocity); offset != 0.0) {
    left_after.array() -= offset;
    offset_after = offset;
    result.nuisances.push_back(fmt::format("offset of {} refitted on its first 5 %", recording.name));
    // the comparison must not gain by it: the baseline takes its own, or none if that is better
    double const own = head_offset(left_before, velocity);
    Eigen::VectorXd const refitted = left_before.array() - own;
    if (refitted.squaredNorm() < left_before.squaredNorm()) {
      left_before = refitted;
      offset_before = own;
    }
  }
  Eigen::VectorXd shares = Eigen::VectorXd::Ones(before.torque.size());
  plain.take_shares(shares, before.kept_rows);
  result.torque_energy = weighed_energy(before.whole_torque(), shares);
  result.energies = energies_of(left_before, left_after, shares);
  result.left_out = left_out_of(recording, setting, {baseline, {baseline.model(), baseline.estimate()}, offset_before},
                                {augmented, *result.there, offset_after}, before.kept_rows);
  result.kept_rows = before.kept_rows;
  result.memory_rows = guard_rows(plain);
  for (std::size_t i = 0; i < augmented.model().effects().size(); ++i)
    result.by_effect.push_back(without_effect(augmented, i, after, parameters, left_with, artefacts.after, shares));
  result.trace = torque_trace(recording, plain, before, left_before, left_after);
  result.left_before = left_before.cwiseProduct(shares);
  result.left_after = left_after.cwiseProduct(shares);
  return result;
}

}  // namespace

Recording from_zero(Recording recording) {
  double const start = recording.time_s.size() > 0 ? recording.time_s[0] : 0.0;
  recording.time_s.array() -= start;
  return recording;
}

TorqueTrace torque_trace(Recording const& recording, RecordPipeline const& pipeline, ProcessedRecord const& before,
                         Eigen::VectorXd const& residual_before, Eigen::VectorXd const& residual_after) {
  TorqueTrace trace;
  trace.recording = recording.name;
  trace.rate_hz = pipeline.kept_rate_hz();
  trace.time_s = pipeline.picked(before.motion->time_s);
  trace.torque = pipeline.filtered(acting_torque(before.motion->torque));
  if (recording.gear_load.size() > 0) trace.torque += pipeline.filtered(recording.gear_load);
  trace.velocity = pipeline.picked(before.motion->dq);
  trace.position = pipeline.picked(before.motion->q);
  trace.before = trace.after = Eigen::VectorXd::Constant(trace.time_s.size(), unknown);
  for (std::size_t i = 0; i < before.kept_rows.size(); ++i) {
    trace.before[before.kept_rows[i]] = residual_before[static_cast<Eigen::Index>(i)];
    trace.after[before.kept_rows[i]] = residual_after[static_cast<Eigen::Index>(i)];
  }
  return trace;
}

ForwardSimulation simulate_forward(Recording const& recording, std::optional<RecordedLoop> const& loop,
                                   ModelStage const& baseline, ModelStage const& augmented,
                                   ModelElsewhere const& there) {
  ForwardSimulation result;
  result.recording = recording.name;
  result.encoder_step = baseline.twin->loop.loop.encoder_step;
  double const mean = recording.position.mean();
  result.motion_rms = std::sqrt((recording.position.array() - mean).square().mean());
  if (!loop || loop->source == LoopSource::tracking) return result;
  result.before_rms = position_error(recording, *loop, baseline, {baseline.model(), baseline.estimate()});
  result.after_rms = position_error(recording, *loop, augmented, there);
  return result;
}

LeftOutRows left_out_in_training(StageSetting const& setting, ModelStage const& baseline, ModelStage const& augmented) {
  auto const fitted = [](ModelStage const& stage) {
    return Predictor{stage, {stage.model(), stage.comparison.recording.parameters}, 0.0};
  };
  return left_out_of(setting.recording, setting, fitted(baseline), fitted(augmented),
                     baseline.comparison.recording.kept_rows);
}

UnseenResult check_unseen(Recording const& given, StageSetting const& setting, ModelStage const& baseline,
                          ModelStage const& augmented, std::shared_ptr<NoiseWeights const> weights) {
  Recording const recording = from_zero(given);
  auto const loop = loop_of(recording, setting, augmented);
  Artefact artefact;
  if (!weights || !weights->weigh_reversals()) weights = {};
  if (loop && weights)
    artefact = [&](ModelStage const& model, std::vector<Eigen::Index> const& rows) -> Eigen::VectorXd {
      try {
        return processing_artefact(recording, setting, model, *loop, rows);
      } catch (Error const&) {
        return {};  // as below
      }
    };
  UnseenResult result{predict(recording, setting, baseline, augmented, artefact, weights)};
  if (!(result.torque_energy > 0.0)) return result;
  result.forward = simulate_forward(recording, loop, baseline, augmented, *result.there);
  if (!loop) return result;
  try {
    account_for_twins(recording, setting, augmented, *loop, weights, result);
  } catch (Error const&) {
    // twins of this recording cannot be fitted: it does not excite an effect of the training recording; no floor then
  }
  return result;
}

}  // namespace torquescope
