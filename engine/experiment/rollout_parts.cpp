#include "engine/experiment/rollout_parts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "engine/base/error.hpp"
#include "engine/data/filter_checks.hpp"
#include "engine/effects/fitted_baseline.hpp"
#include "engine/experiment/job_sections.hpp"
#include "engine/experiment/servo_job.hpp"
#include "engine/fit/problem/plain_least_squares.hpp"
#include "engine/simulate/controller_fit.hpp"
#include "engine/simulate/rollout/effect_starts.hpp"
#include "engine/simulate/rollout/loop_gains.hpp"

namespace torquescope {
namespace {

std::optional<double> number_of(Setting const& setting) {
  auto const value = converted(setting.value, 0.0);
  return value ? std::optional(std::get<double>(*value)) : std::nullopt;
}

void read_effect(Section const& section, Regressor const& regressor, RolloutPlan& plan,
                 std::vector<Problem>& problems) {
  Setting const* const name = section.find("name");
  auto const* const word = name ? std::get_if<std::string>(&name->value) : nullptr;
  Effect const* const effect = word ? find_effect(*word) : nullptr;
  if (effect == nullptr || !effect->exists_on(regressor.joint()) || effect->is_given() || effect->is_of_whole_arm()) {
    problems.push_back(problem_at(
        section, "name",
        word ? fmt::format("\"{}\" is no effect of such a joint", *word) : "an effect of [[model.effects]] has no name",
        "torquescope list effects"));
    return;
  }
  ModelEffect given{effect, {}};
  std::vector<std::string> known{"name"};
  for (auto const& parameter : effect->parameters()) known.push_back(parameter.name);
  for (auto const& setting : section.settings) {
    if (setting.key == "name") continue;
    if (std::find(known.begin(), known.end(), setting.key) == known.end()) {
      problems.push_back(unknown_key(section, setting, known));
    } else if (auto const value = number_of(setting)) {
      given.values[setting.key] = *value;
    } else {
      problems.push_back(wrong_type(section, setting, 0.0));
    }
  }
  plan.effects.push_back(std::move(given));
}

// drives cannot have less than nothing of them: missing physics bends least squares there
Eigen::VectorXd possible_start(Regressor const& regressor, Eigen::VectorXd start, JointScales const& scales) {
  Eigen::Index at = 0;
  for (auto const* term : regressor.terms()) {
    double& value = start[at];
    at += static_cast<Eigen::Index>(term->n_linear());
    if (term->name() == "inertia" && !(value > 0.0)) value = bound_value({0.1, RelativeTo::inertia}, scales);
    if (term->name() == "coulomb") value = std::max(value, 0.0);
  }
  return start;
}

std::string said(LoopForm form, LoopOrigin origin) {
  switch (origin) {
    case LoopOrigin::given:
      return fmt::format("controller {} as [loop] gives it", word(form));
    case LoopOrigin::fitted:
      return fmt::format("controller {} with gains from the recording", word(form));
    default:
      return {};
  }
}

// Recordings of one rig have one controller. Where something else acts on a recording (pulses), its own controller is
// bent by that; the controller of the first training recording is taken where it answers the recorded torque more
// closely
void share_controller(RolloutData const& train, RolloutData& data) {
  auto const& controller = train.tracks.front().controller;
  if (!controller) return;
  for (std::size_t k = 0; k < data.tracks.size(); ++k) {
    auto& track = data.tracks[k];
    if (!track.controller || loop_error(*track.controller, track) <= loop_error(*controller, track)) continue;
    track.controller = controller;
    data.origins[k] = train.origins.front();
    data.loop_words[k] = fmt::format("the controller of {}, which fits this recording better than one of its own",
                                     train.tracks.front().name);
  }
}

// gains that the job leaves out, and the samples that the controller's speed spans
LoopSetting with_loop_of(LoopSetting setting, LoopOptions const& loop, std::vector<RolloutTrack> const& tracks) {
  if (gains_of(setting.form).empty() || tracks.front().drive != TrackDrive::reference) return setting;
  auto const missing = missing_gains(loop);
  if (setting.speed_samples > 0 && loop.speed_samples == 0)
    setting.speed_samples = speed_span(setting.form, setting.values, missing, tracks);
  setting.values = with_first_gains(setting.form, setting.values, missing, setting.speed_samples, tracks);
  return setting;
}

// rate and speed of the controller, behind what is said of it
void say_how_loops_answer(RolloutParts& rollout, LoopSetting const& setting) {
  for (auto* data : {&rollout.train, &rollout.validate})
    for (auto& words : data->loop_words)
      if (rollout.plan.loop.rate_hz > 0.0 && !words.empty()) {
        auto const& track = rollout.train.tracks.front();
        double const slower = static_cast<double>(setting.hold_ticks);
        words += fmt::format(", at {:g} Hz", 1.0 / (track.tick_s() * slower));
      }
  for (auto* data : {&rollout.train, &rollout.validate})
    for (std::size_t k = 0; k < data->tracks.size(); ++k)
      if (data->origins[k] == LoopOrigin::given || data->origins[k] == LoopOrigin::fitted)
        data->loop_words[k] += setting.speed_samples == 0
                                   ? ", which sees the joint's speed"
                                   : fmt::format(", whose speed is a difference over {} sample{}",
                                                 setting.speed_samples, setting.speed_samples == 1 ? "" : "s");
}

}  // namespace

std::string word(LoopOrigin origin) {
  switch (origin) {
    case LoopOrigin::given:
      return "given";
    case LoopOrigin::fitted:
      return "fitted";
    case LoopOrigin::identified:
      return "identified";
    case LoopOrigin::approximated:
      return "approximated";
    case LoopOrigin::none:
      break;
  }
  return "none";
}

RolloutPlan plan_rollouts(Job const& job, Regressor const& regressor, std::vector<Problem>& problems) {
  RolloutPlan plan;
  plan.is_servo = has_recording_set(job);
  if (plan.is_servo) {
    plan.loop = searched_servo_loop(servo_loop(job, problems), known_keys(job));
  } else {
    plan.loop = read_options<LoopOptions>(job, problems);
    check_loop(plan.loop, section_or_empty(job, "loop"), problems);
  }
  for (Section const* section : job.all("model.effects")) read_effect(*section, regressor, plan, problems);
  auto const names = regressor.names();
  if (Section const* given = job.find("model.given"))
    for (auto const& setting : given->settings) {
      if (std::find(names.begin(), names.end(), setting.key) == names.end()) {
        problems.push_back(unknown_key(*given, setting, names));
      } else if (auto const value = number_of(setting)) {
        plan.given[setting.key] = *value;
      } else {
        problems.push_back(wrong_type(*given, setting, 0.0));
      }
    }
  return plan;
}

RolloutParts begin_rollouts(RolloutPlan plan, Regressor const& regressor) {
  RolloutParts parts;
  RolloutModel const blank(regressor, Eigen::VectorXd::Zero(static_cast<Eigen::Index>(regressor.size())), {},
                           plan.effects, loop_setting(plan.loop, 1.0));
  for (auto const& one : blank.parameters()) {
    parts.names.push_back(one.name);
    parts.units.push_back(one.unit);
  }
  parts.plan = std::move(plan);
  return parts;
}

RolloutData rollout_data(std::vector<Recording> recordings, LoopOptions const& loop, FilterOptions const& filter,
                         Section const& filter_section) {
  RolloutData data;
  LoopForm const form = form_of(loop);
  for (auto const& recording : recordings) {
    Recording seen = recording;
    if (form == LoopForm::none) seen.reference.resize(0);
    RolloutTrack track = track_of(seen, track_options(loop));
    LoopOrigin origin = form == LoopForm::identified || form == LoopForm::none ? LoopOrigin::none
                        : missing_gains(loop).empty()                          ? LoopOrigin::given
                                                                               : LoopOrigin::fitted;
    std::string words = said(form, origin);
    if (track.drive == TrackDrive::torque) {
      origin = LoopOrigin::none;
      words = form == LoopForm::none
                  ? "no controller: the recorded torque drives the joint"
                  : "no reference was recorded: the recorded torque drives the joint; record the commanded position";
    } else if (form == LoopForm::identified) {
      Eigen::VectorXd torque = recording.torque;
      double const gain = loop_setting(loop, recording.rate_hz).values[LoopKey::added_command_gain];
      if (recording.added_command.size() > 0) torque -= gain * recording.added_command;
      ControllerFit const fit =
          fit_controller({recording.time_s, recording.reference, recording.position, torque, nullptr});
      track.controller = fit.controller;
      origin = fit.is_white ? LoopOrigin::identified : LoopOrigin::approximated;
      words = fit.remark;
    }
    data.velocity.push_back(recording.velocity.size() > 0 ? recording.velocity
                                                          : differentiate(recording, filter, filter_section).dq);
    data.tracks.push_back(std::move(track));
    data.origins.push_back(origin);
    data.loop_words.push_back(std::move(words));
  }
  data.recordings = std::move(recordings);
  return data;
}

void add_recordings(RolloutParts& rollout, Regressor const& regressor, std::vector<Recording> train,
                    std::vector<Recording> validate, RegressionData const& rows, FilterOptions const& filter,
                    Section const& filter_section) {
  LoopOptions const& loop = rollout.plan.loop;
  rollout.train = rollout_data(std::move(train), loop, filter, filter_section);
  rollout.validate = rollout_data(std::move(validate), loop, filter, filter_section);
  share_controller(rollout.train, rollout.train);
  share_controller(rollout.train, rollout.validate);
  rollout.least_squares = plain_least_squares(rows, 0).parameters;
  Recording const& first = rollout.train.recordings.front();
  Motion const motion = differentiate(first, filter, filter_section);
  double const encoder_step = rollout.train.tracks.front().encoder_step;
  double const band_hz = torque_band_of(filter, first.rate_hz);
  auto const scales_with = [&](Eigen::VectorXd const& parameters) {
    return fitted_baseline(regressor, {parameters.data(), static_cast<std::size_t>(parameters.size())}, motion, band_hz,
                           encoder_step)
        .scales;
  };
  Eigen::VectorXd start = possible_start(regressor, rollout.least_squares, scales_with(rollout.least_squares));
  auto const names = regressor.names();
  for (std::size_t k = 0; k < names.size(); ++k)
    if (auto const given = rollout.plan.given.find(names[k]); given != rollout.plan.given.end())
      start[static_cast<Eigen::Index>(k)] = given->second;
  std::vector<ModelEffect> effects = rollout.plan.effects;
  if (!effects.empty()) {
    FittedBaseline const baseline = fitted_baseline(regressor, {start.data(), static_cast<std::size_t>(start.size())},
                                                    motion, band_hz, encoder_step);
    effects = with_first_shapes(std::move(effects), motion, baseline, motion.torque - baseline.model_torque);
  }
  LoopSetting setting = loop_setting(loop, first.rate_hz);
  setting = with_loop_of(std::move(setting), loop, rollout.train.tracks);
  // of recordings without a reference there is no controller, whatever the job says
  if (rollout.train.tracks.front().drive == TrackDrive::torque) {
    setting.form = LoopForm::none;
    std::erase_if(setting.free, [&](LoopKey key) {
      auto const gains = gains_of(form_of(loop));
      return std::find(gains.begin(), gains.end(), key) != gains.end();
    });
  }
  say_how_loops_answer(rollout, setting);
  rollout.model.emplace(regressor, start, scales_with(start), effects, setting);
  rollout.variance = variance_at_start(rollout);
}

ChannelNumbers variance_at_start(RolloutParts const& rollout) {
  RolloutTask task{rollout.train.tracks, {}, channels_of(rollout.plan.loop)};
  for (auto const& track : task.tracks)
    task.structures.push_back(rollout.model->structure_for(rollout.model->start(), track.tick_s()));
  std::vector<RolloutTrial> const trial{rollout.model->trial(rollout.model->start())};
  ChannelNumbers const sums = sums_of_squares(task, trial, 1).front();
  ChannelNumbers variance{};
  for (std::size_t channel = 0; channel < n_channels; ++channel) {
    double n = 0.0, energy = 0.0;
    for (std::size_t t = 0; t < task.tracks.size(); ++t) {
      auto const& track = task.tracks[t];
      if (!task.count(t, channel)) continue;
      n += static_cast<double>(track.samples());
      Eigen::VectorXd const& signal = channel == 0 ? track.position : track.torque;
      energy += (signal.array() - signal.mean()).square().sum();
    }
    double const left = std::isfinite(sums[channel]) && sums[channel] > 0.0 ? sums[channel] : energy;
    variance[channel] = n > 0.0 ? left / n : 0.0;
  }
  return variance;
}

Bounds rollout_box(RolloutModel const& model) {
  constexpr double ten = 10.0, tenth = 0.1, three = 3.0;
  Bounds box;
  for (auto const& one : model.parameters()) {
    double lower = one.lower, upper = one.upper;
    double const size = std::max(std::abs(one.start), tenth * one.scale);
    if (!one.is_shape) {
      bool const is_positive = one.lower >= 0.0;
      lower = std::max(one.lower, is_positive ? tenth * std::abs(one.start) : one.start - three * size);
      upper = std::min(one.upper, is_positive ? ten * size : one.start + three * size);
    }
    box.lower.push_back(lower);
    box.upper.push_back(upper > lower ? upper : lower + one.scale);
  }
  return box;
}

}  // namespace torquescope
