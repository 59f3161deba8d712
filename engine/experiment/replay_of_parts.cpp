#include "engine/experiment/replay_of_parts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "engine/base/error.hpp"
#include "engine/base/parallel.hpp"
#include "engine/experiment/job_sections.hpp"
#include "engine/experiment/model_effects.hpp"
#include "engine/simulate/rollout/loop_gains.hpp"

namespace torquescope {

namespace {

constexpr char const* as_identified = "as identified";

// the loop as the recordings were read, nothing left to search
LoopSetting settled_loop(RolloutParts const& rollout) {
  LoopSetting setting = rollout.model->loop();
  setting.free.clear();
  return setting;
}

RolloutModel model_with(Experiment::Parts const& parts, RolloutParts const& rollout, Eigen::VectorXd const& terms,
                        JointScales const& scales, std::vector<ModelEffect> const& effects) {
  return {*parts.regressor, terms, scales, effects, settled_loop(rollout)};
}

ReplaySource source_of(std::string name, RolloutModel model) {
  Eigen::VectorXd const start = model.start();
  return {std::move(name), std::move(model), start};
}

// the regressor's parameters by name; nothing where one is missing
std::optional<Eigen::VectorXd> terms_of(Regressor const& regressor, std::vector<ParameterEstimate> const& from) {
  auto const names = regressor.names();
  Eigen::VectorXd values(static_cast<Eigen::Index>(names.size()));
  for (std::size_t k = 0; k < names.size(); ++k) {
    auto const found = std::find_if(from.begin(), from.end(), [&](auto const& one) { return one.name == names[k]; });
    if (found == from.end() || !std::isfinite(found->value)) return std::nullopt;
    values[static_cast<Eigen::Index>(k)] = found->value;
  }
  return values;
}

std::vector<ModelEffect> effects_of(JointDiagnosis const& joint, Regressor const& regressor) {
  std::vector<ModelEffect> effects;
  for (auto const& estimated : estimated_effects(joint)) {
    auto const& terms = regressor.terms();
    if (estimated.effect == nullptr || std::find(terms.begin(), terms.end(), estimated.effect) != terms.end()) continue;
    ModelEffect given{estimated.effect, {}};
    // numbered waves have the names of their effect, in its order
    for (auto const& parameter : estimated.effect->parameters())
      for (auto const* list : {&estimated.parameters, &estimated.held})
        for (auto const& one : *list)
          if (one.name == parameter.name || one.name.starts_with(parameter.name + "_"))
            given.values.emplace(parameter.name, one.value);
    effects.push_back(std::move(given));
  }
  return effects;
}

// what effects took from the fitted baseline
JointScales scales_of(RolloutParts const& rollout, JointDiagnosis const& joint) {
  JointScales scales = rollout.model->structure().scales;
  if (std::isfinite(joint.effect_levels.forward)) scales.coulomb_positive = joint.effect_levels.forward;
  if (std::isfinite(joint.effect_levels.backward)) scales.coulomb_negative = -joint.effect_levels.backward;
  if (std::isfinite(joint.effect_levels.inertia)) scales.inertia = joint.effect_levels.inertia;
  return scales;
}

}  // namespace

std::vector<ReplaySource> sources_of_job(Experiment::Parts const& parts, RolloutParts const& rollout) {
  Eigen::VectorXd const terms = rollout.model->start().head(static_cast<Eigen::Index>(parts.regressor->size()));
  bool const all_given = rollout.plan.given.size() == parts.regressor->size();
  JointScales const& scales = rollout.model->structure().scales;
  std::vector<ReplaySource> sources;
  sources.push_back(source_of(all_given ? "as given" : as_identified, model_with(parts, rollout, terms, scales, {})));
  if (rollout.plan.effects.empty()) return sources;
  for (auto const& given : rollout.plan.effects)
    for (auto const& parameter : given.effect->parameters())
      validate(given.values.contains(parameter.name), [&] {
        Problem problem{ExitCode::bad_job,
                        fmt::format("[[model.effects]] {} has no {}", given.effect->name(), parameter.name)};
        problem.help =
            "write it, or let `torquescope run` fit it with [[estimator]] name = \"lm\" and replay the result";
        return problem;
      });
  sources.push_back(
      source_of("with the effects of the job", model_with(parts, rollout, terms, scales, rollout.plan.effects)));
  return sources;
}

std::vector<ReplaySource> sources_of_diagnosis(Experiment::Parts const& parts, RolloutParts const& rollout,
                                               Diagnosis const& diagnosis) {
  std::vector<ReplaySource> sources;
  if (diagnosis.joints.empty()) return sources;
  JointDiagnosis const& joint = diagnosis.joints.front();
  JointScales const scales = scales_of(rollout, joint);
  auto const before = terms_of(*parts.regressor, joint.baseline);
  if (!before) return sources;
  sources.push_back(source_of(as_identified, model_with(parts, rollout, *before, scales, {})));
  auto const after = terms_of(*parts.regressor, joint.augmented);
  if (after && !joint.effects.empty())
    sources.push_back(source_of("with what was named",
                                model_with(parts, rollout, *after, scales, effects_of(joint, *parts.regressor))));
  return sources;
}

void add_source_of_run(Experiment::Parts const& parts, RolloutParts const& rollout, std::string const& label,
                       std::vector<std::string> const& names, std::vector<double> const& parameters,
                       std::vector<ReplaySource>& sources) {
  RolloutModel const& model = *rollout.model;
  Eigen::VectorXd values(static_cast<Eigen::Index>(model.size()));
  for (std::size_t k = 0; k < model.size(); ++k) {
    auto const found = std::find(names.begin(), names.end(), model.parameters()[k].name);
    if (found == names.end()) return;
    auto const at = static_cast<std::size_t>(found - names.begin());
    if (at >= parameters.size() || !std::isfinite(parameters[at])) return;
    values[static_cast<Eigen::Index>(k)] = parameters[at];
  }
  // where rollouts began, so that a fit by them shows what it gained
  bool const is_first = sources.empty();
  if (is_first && parts.rolls_out())
    sources.push_back(
        source_of("by least squares",
                  model_with(parts, rollout, model.start().head(static_cast<Eigen::Index>(parts.regressor->size())),
                             model.structure().scales, {})));
  sources.push_back({label, model, values});
}

Replay replay_of(Experiment::Parts const& parts, RolloutParts const& rollout, std::vector<ReplaySource> const& sources,
                 int threads) {
  Replay replay;
  for (auto const& source : sources) replay.models.push_back(source.name);
  replay.after = sources.size() - 1;
  replay.is_prismatic = parts.regressor->joint() == JointKind::prismatic;
  replay.torque_unit = parts.torque_unit();
  std::size_t const n_train = rollout.train.tracks.size(), all = n_train + rollout.validate.tracks.size();
  replay.recordings.resize(all);
  parallel_for(all, threads, [&](std::size_t i, int) {
    bool const is_validation = i >= n_train;
    RolloutData const& data = is_validation ? rollout.validate : rollout.train;
    std::size_t const k = is_validation ? i - n_train : i;
    RolloutTrack const& track = data.tracks[k];
    std::vector<ReplayedModel> models;
    for (auto const& source : sources)
      models.push_back(
          {source.model.structure_for(source.parameters, track.tick_s()), source.model.trial(source.parameters)});
    RecordingReplay made = replay_recording(data.recordings[k], track, data.velocity[k], models);
    made.is_validation = is_validation;
    made.loop = word(data.origins[k]);
    made.loop_words = data.loop_words[k];
    if (track.drive == TrackDrive::torque)
      made.window_s = rollout.plan.loop.window_s;
    else
      made.loop_error = track.controller
                            ? loop_error(*track.controller, track)
                            : loop_error(models.back().trial.loop, models.back().structure.speed_samples, track);
    replay.recordings[i] = std::move(made);
  });
  bool const has_simulator = std::any_of(replay.recordings.begin(), replay.recordings.end(),
                                         [&](auto const& one) { return one.diverged.size() > sources.size(); });
  if (!has_simulator) return replay;
  replay.models.emplace_back(users_simulator);
  // a recording without the simulator's columns has nothing of it
  for (auto& one : replay.recordings) {
    if (one.diverged.size() > sources.size()) continue;
    one.diverged.push_back(false);
    for (auto& channel : one.channels) {
      if (channel.measured.size() == 0) continue;
      constexpr double nan = std::numeric_limits<double>::quiet_NaN();
      channel.simulated.push_back(Eigen::VectorXd::Constant(channel.measured.size(), nan));
      channel.errors.push_back({channel.errors.front().samples, nan, nan, nan});
    }
  }
  return replay;
}

std::optional<Replay> replay_of_diagnosis(Experiment::Parts const& parts, Diagnosis const& diagnosis, int threads) {
  if (!parts.regressor || diagnosis.joints.empty() || diagnosis.joints.front().baseline.empty()) return std::nullopt;
  try {
    std::vector<Problem> problems;
    RolloutParts rollout = begin_rollouts(plan_rollouts(parts.job, *parts.regressor, problems), *parts.regressor);
    // a diagnosis begins at the terms of the model alone
    rollout.plan.effects.clear();
    add_recordings(rollout, *parts.regressor, parts.train.recordings,
                   parts.validate ? parts.validate->recordings : std::vector<Recording>(), parts.train.regression,
                   parts.filter, section_or_empty(parts.job, "filter"));
    auto const sources = sources_of_diagnosis(parts, rollout, diagnosis);
    if (sources.empty()) return std::nullopt;
    return replay_of(parts, rollout, sources, threads);
  } catch (Error const&) {
    // what cannot be simulated has been diagnosed all the same
    return std::nullopt;
  }
}

}  // namespace torquescope
