#include "engine/diagnose/unseen_record.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "engine/base/error.hpp"
#include "engine/diagnose/scaled_solution.hpp"
#include "engine/diagnose/twin_batch.hpp"
#include "engine/diagnose/unseen_floor.hpp"
#include "engine/simulate/autoregression.hpp"

namespace torquescope {
namespace {

// the training parameters, those of events taken out
Eigen::VectorXd transferable(ModelStage const& stage, std::vector<std::string>& nuisances) {
  Eigen::VectorXd parameters = stage.parameters();
  auto const& effects = stage.model().effects();
  for (std::size_t i = 0; i < effects.size(); ++i) {
    if (!effects[i].effect->is_event()) continue;
    parameters
        .segment(static_cast<Eigen::Index>(stage.model().first_parameter(i)),
                 static_cast<Eigen::Index>(effects[i].effect->n_linear()))
        .setZero();
    nuisances.push_back(effects[i].effect->name() + " left out: its instant belongs to the training recording");
  }
  return parameters;
}

// rows of the head on which nuisances are refitted
Eigen::Index head_rows(Eigen::Index rows) {
  constexpr Eigen::Index head_share = 20, fewest = 50;
  return std::min(rows, std::max(fewest, rows / head_share));
}

// a head that moves one way only cannot tell an offset from what friction is in that direction
bool moves_both_ways(Eigen::VectorXd const& velocity) {
  constexpr double fifth = 0.2;
  Eigen::Index const n = head_rows(velocity.size());
  auto const forward = (velocity.head(n).array() > 0.0).count();
  return static_cast<double>(std::min(forward, n - forward)) >= fifth * static_cast<double>(n);
}

// mean of the head when it is beyond chance, else 0
double head_offset(Eigen::VectorXd const& residual, Eigen::VectorXd const& velocity) {
  constexpr double beyond = 3.0;
  if (!moves_both_ways(velocity)) return 0.0;
  Eigen::Index const n = head_rows(residual.size());
  Eigen::VectorXd const head = residual.head(n);
  double const mean = head.mean();
  Eigen::VectorXd const apart = head.array() - mean;
  // neighbours repeat each other: an autoregression of order 1 says how often
  double const r = std::clamp(autocorrelation(apart, 1), 0.0, 0.99);
  double const error =
      std::sqrt(apart.squaredNorm() / static_cast<double>(n - 1) * (1.0 + r) / (1.0 - r) / static_cast<double>(n));
  return std::abs(mean) > beyond * error ? mean : 0.0;
}

// whether a refit that leaves `least` of the head is beyond chance: three standard deviations; neighbours repeat each other
bool gains_beyond_chance(Eigen::Ref<Eigen::VectorXd const> const& head, double least) {
  constexpr double beyond = 9.0;
  double const r = std::clamp(autocorrelation(head, 1), 0.0, 0.99);
  double const variance = least / static_cast<double>(head.size()) * (1.0 + r) / (1.0 - r);
  return head.squaredNorm() - least > beyond * variance;
}

// Where a counter begins to count is another place in each recording, and so is when a clock begins: a wave keeps its size
// and order, or frequency, and may turn its phase: to the one that fits the head best, when that is beyond chance.
bool turn_phase(Eigen::MatrixXd const& wave, Eigen::VectorXd const& left, Eigen::Ref<Eigen::VectorXd> amplitudes) {
  constexpr int directions = 360;
  Eigen::Index const n = head_rows(left.size());
  Eigen::MatrixXd const head = wave.topRows(n);
  Eigen::VectorXd const wanted = left.head(n) + head * amplitudes;
  double const size = amplitudes.norm();
  Eigen::Vector2d best = amplitudes;
  double least = left.head(n).squaredNorm();
  for (int k = 0; k < directions; ++k) {
    double const angle = 2.0 * std::numbers::pi * k / directions;
    Eigen::Vector2d const turned(size * std::cos(angle), size * std::sin(angle));
    double const energy = (wanted - head * turned).squaredNorm();
    if (energy >= least) continue;
    least = energy;
    best = turned;
  }
  if (!gains_beyond_chance(left.head(n), least)) return false;
  amplitudes = best;
  return true;
}

// a cosine and a sine, and nothing else
bool is_plain_wave(Effect const& effect) { return effect.n_linear() == 2 && effect.n_shape() == 1 && effect.is_wave(); }

void turn_waves(ModelStage const& stage, ProcessedRecord const& record, Eigen::VectorXd& parameters,
                std::vector<std::string>& nuisances) {
  auto const& effects = stage.model().effects();
  for (std::size_t i = 0; i < effects.size(); ++i) {
    if (!is_plain_wave(*effects[i].effect)) continue;
    auto const first = static_cast<Eigen::Index>(stage.model().first_parameter(i));
    Eigen::VectorXd const left = record.torque - record.columns * parameters;
    if (turn_phase(record.columns.middleCols(first, 2), left, parameters.segment(first, 2)))
      nuisances.push_back("phase of " + effects[i].effect->name() + " refitted on the first 5 %");
  }
}

// it runs down from the beginning of a recording, and nobody says how far it had when another one began
bool is_of_the_clock(Effect const& effect) { return effect.family() == EffectFamily::time && !effect.is_event(); }

// How cold the joint still was is a share of what it was in training: the one that fits the head best, when that is beyond chance
bool scale_to_head(Eigen::MatrixXd const& columns, Eigen::VectorXd const& left,
                   Eigen::Ref<Eigen::VectorXd> parameters) {
  Eigen::Index const n = head_rows(left.size());
  Eigen::VectorXd const own = columns.topRows(n) * parameters, wanted = left.head(n) + own;
  if (!(own.squaredNorm() > 0.0)) return false;
  double const share = std::clamp(own.dot(wanted) / own.squaredNorm(), 0.0, 1.0);
  double const least = (wanted - share * own).squaredNorm();
  if (!gains_beyond_chance(left.head(n), least)) return false;
  parameters *= share;
  return true;
}

void scale_clocks(ModelStage const& stage, ProcessedRecord const& record, Eigen::VectorXd& parameters,
                  std::vector<std::string>& nuisances) {
  auto const& effects = stage.model().effects();
  for (std::size_t i = 0; i < effects.size(); ++i) {
    if (!is_of_the_clock(*effects[i].effect)) continue;
    auto const first = static_cast<Eigen::Index>(stage.model().first_parameter(i));
    auto const width = static_cast<Eigen::Index>(effects[i].effect->n_linear());
    Eigen::VectorXd const left = record.torque - record.columns * parameters;
    if (scale_to_head(record.columns.middleCols(first, width), left, parameters.segment(first, width)))
      nuisances.push_back("how far " + effects[i].effect->name() + " had gone refitted on the first 5 %");
  }
}

void check_rows(ProcessedRecord const& record, std::string const& name) {
  validate(static_cast<Eigen::Index>(record.kept_rows.size()) >= fewest_rows, [&] {
    Problem problem{ExitCode::bad_data, fmt::format("{}: only {} rows are left between reversals, {} are needed", name,
                                                    record.kept_rows.size(), fewest_rows)};
    problem.help = "give a longer recording as validate, or none";
    return problem;
  });
}

// the loop that another recording was made in, without levels; none where twins follow a measured motion
std::optional<RecordedLoop> loop_of(Recording const& recording, ModelStage const& stage) {
  if (stage.twin->loop.source == LoopSource::tracking || recording.reference.size() != recording.position.size())
    return std::nullopt;
  return recorded_loop(recording, {}, {});
}

double position_error(Recording const& recording, RecordedLoop const& loop, ModelStage const& stage) {
  CleanTwin const twin(stage.model().twin_joint(stage.parameters()), noiseless(loop.loop), loop.track,
                       stage.twin->twin.step_s());
  TwinGroup group;
  twin.simulate({}, 0, group);
  if (group.ran_away[0]) return unknown;
  return std::sqrt((group.position[0] - recording.position).squaredNorm() /
                   static_cast<double>(recording.position.size()));
}

// what its twins leave, and whether that is a floor of it
void account_for_twins(Recording const& recording, StageSetting const& setting, ModelStage const& stage,
                       RecordedLoop const& loop, UnseenResult& result) {
  auto const errors_in = [&](RecordedLoop const& one) {
    return unseen_twin_errors(recording, setting, stage, one, stage.parameters());
  };
  TwinErrors const own = errors_in(loop);
  result.promised = own.mean;
  result.twins_ran_away = !std::isfinite(own.mean);
  double const relerr = std::sqrt(result.after_energy / result.energy);
  result.floor = floor_below(relerr, own);
  RecordedLoop const& trained = stage.twin->loop;
  if (std::isfinite(result.floor) || result.twins_ran_away || trained.track.rate_hz != loop.track.rate_hz) return;
  result.floor = floor_below(relerr, errors_in(with_law_of(trained, loop)));
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
  trace.time_s = pipeline.picked(before.motion.time_s);
  trace.torque = pipeline.filtered(before.motion.torque);
  trace.velocity = pipeline.picked(before.motion.dq);
  trace.position = pipeline.picked(before.motion.q);
  trace.before = trace.after = Eigen::VectorXd::Constant(trace.time_s.size(), unknown);
  for (std::size_t i = 0; i < before.kept_rows.size(); ++i) {
    trace.before[before.kept_rows[i]] = residual_before[static_cast<Eigen::Index>(i)];
    trace.after[before.kept_rows[i]] = residual_after[static_cast<Eigen::Index>(i)];
  }
  return trace;
}

ForwardSimulation simulate_forward(Recording const& recording, std::optional<RecordedLoop> const& loop,
                                   ModelStage const& baseline, ModelStage const& augmented) {
  ForwardSimulation result;
  result.recording = recording.name;
  result.encoder_step = baseline.twin->loop.loop.encoder_step;
  double const mean = recording.position.mean();
  result.motion_rms = std::sqrt((recording.position.array() - mean).square().mean());
  if (!loop || loop->source == LoopSource::tracking) return result;
  result.before_rms = position_error(recording, *loop, baseline);
  result.after_rms = position_error(recording, *loop, augmented);
  return result;
}

UnseenPrediction predict_unseen(Recording const& given, StageSetting const& setting, ModelStage const& baseline,
                                ModelStage const& augmented) {
  Recording const recording = from_zero(given);
  UnseenPrediction result;
  RecordPipeline const plain = pipeline_for(setting, recording, baseline.model());
  RecordPipeline full = pipeline_for(setting, recording, augmented.model());
  ProcessedRecord const before = plain.prepare(recording);
  check_rows(before, recording.name);
  full.restrict_to(before.kept_rows);
  ProcessedRecord const after = full.prepare(recording);
  Eigen::VectorXd parameters = transferable(augmented, result.nuisances);
  turn_waves(augmented, after, parameters, result.nuisances);
  scale_clocks(augmented, after, parameters, result.nuisances);
  Eigen::VectorXd left_before = before.torque - before.columns * baseline.parameters();
  Eigen::VectorXd left_after = after.torque - after.columns * parameters;
  Eigen::VectorXd const velocity = plain.picked(before.motion.dq, before);
  if (augmented.model().effects().empty()) {
    left_after = left_before;  // one model: nothing to compare, nothing to refit
  } else if (double const offset = head_offset(left_after, velocity); offset != 0.0) {
    left_after.array() -= offset;
    result.nuisances.push_back(fmt::format("offset of {} refitted on its first 5 %", recording.name));
    // the comparison must not gain by it: the baseline takes its own, or none if that is better
    Eigen::VectorXd const refitted = left_before.array() - head_offset(left_before, velocity);
    if (refitted.squaredNorm() < left_before.squaredNorm()) left_before = refitted;
  }
  result.energy = before.torque.squaredNorm();
  result.before_energy = left_before.squaredNorm();
  result.after_energy = left_after.squaredNorm();
  result.moved_energy = (left_before - left_after).squaredNorm();
  result.blocks = added_torque(left_before, left_after);
  for (std::size_t i = 0; i < augmented.model().effects().size(); ++i) {
    auto const first = static_cast<Eigen::Index>(augmented.model().first_parameter(i));
    auto const width = static_cast<Eigen::Index>(augmented.model().effects()[i].effect->n_linear());
    // what the other terms would have been fitted to without it
    auto const& trained = augmented.comparison.recording;
    std::vector<Eigen::Index> others;
    for (Eigen::Index k = 0; k < trained.columns.cols(); ++k)
      if (k < first || k >= first + width) others.push_back(k);
    Eigen::MatrixXd const rest = trained.columns(Eigen::all, others);
    Eigen::VectorXd const bias = augmented.parameters() - trained.parameters;
    Eigen::VectorXd const refitted = solve_scaled(rest, trained.torque) + bias(others);
    Eigen::VectorXd const left = after.torque - after.columns(Eigen::all, others) * refitted;
    Eigen::VectorXd const left_with = after.torque - after.columns * parameters;
    result.without.push_back(
        {left.squaredNorm(), left.squaredNorm() - left_with.squaredNorm(), (left - left_with).squaredNorm()});
  }
  result.trace = torque_trace(recording, plain, before, left_before, left_after);
  return result;
}

UnseenResult check_unseen(Recording const& given, StageSetting const& setting, ModelStage const& baseline,
                          ModelStage const& augmented) {
  Recording const recording = from_zero(given);
  UnseenResult result{predict_unseen(given, setting, baseline, augmented)};
  auto const loop = loop_of(recording, augmented);
  result.forward = simulate_forward(recording, loop, baseline, augmented);
  if (!loop) return result;
  try {
    account_for_twins(recording, setting, augmented, *loop, result);
  } catch (Error const&) {
    // twins of this recording cannot be fitted: it does not excite an effect of the training recording; no floor then
  }
  return result;
}

}  // namespace torquescope
