// What an Experiment says of itself: the lines `run` prints first and the lines of `check`.

#include <fmt/format.h>

#include <algorithm>
#include <numeric>

#include "engine/base/digest.hpp"
#include "engine/base/torque_unit.hpp"
#include "engine/data/arm_recording.hpp"
#include "engine/data/filter_checks.hpp"
#include "engine/data/health/finding_text.hpp"
#include "engine/diagnose/arms/effect_shapes.hpp"
#include "engine/experiment/arm_findings.hpp"
#include "engine/experiment/arm_wrench.hpp"
#include "engine/experiment/diagnosis_estimate.hpp"
#include "engine/experiment/experiment_parts.hpp"
#include "engine/experiment/job/stored_generations.hpp"
#include "engine/experiment/search_box.hpp"
#include "kernels/dispatch.hpp"

namespace torquescope {

namespace {

std::string counted(std::size_t n, std::string const& thing) {
  return fmt::format("{} {}{}", n, thing, n == 1 ? "" : "s");
}

std::size_t runs_of(EstimatorPlan const& plan, ExperimentOptions const& experiment) {
  return plan.is_closed_form() ? 1 : static_cast<std::size_t>(experiment.runs);
}

std::string excitation_words(Excitation const& facts, JointKind joint) {
  return fmt::format("speed {:.3g} to {:.3g} {}/s, {} reversals, {}", facts.speed_least, facts.speed_most,
                     joint == JointKind::revolute ? "rad" : "m", facts.reversals,
                     counted(static_cast<std::size_t>(facts.quadrants), "quadrant"));
}

std::size_t samples_of(DataSet const& set) {
  return std::accumulate(set.n_samples.begin(), set.n_samples.end(), std::size_t{0});
}

CheckLine::Level level_of(Grade grade) {
  using Level = CheckLine::Level;
  return grade == Grade::fault ? Level::fault : grade == Grade::warning ? Level::warn : Level::note;
}

double seconds_of(DataSet const& set) { return static_cast<double>(samples_of(set)) / set.recordings.front().rate_hz; }

// a cut-off that takes the motion away, or lets the noise of its acceleration through
std::string ruin_words(FilterOptions const& filter, double motion_hz, double noise_hz) {
  constexpr double far_above = 3.0, half = 0.5;  // a low-pass at motion_hz lets 98 % of the velocity through
  if (filter.cutoff_hz > 0.0 && filter.cutoff_hz < half * motion_hz)
    return fmt::format("cutoff_hz = {:g} cuts into the motion itself, which goes up to {:.3g} Hz", filter.cutoff_hz,
                       motion_hz);
  if (noise_hz > 0.0 && (filter.cutoff_hz == 0.0 || filter.cutoff_hz > far_above * noise_hz))
    return fmt::format("{}: above {:.3g} Hz the noise of the position, differentiated twice, drowns the acceleration",
                       filter.cutoff_hz > 0.0 ? fmt::format("cutoff_hz = {:g}", filter.cutoff_hz) : "no cutoff_hz",
                       noise_hz);
  return {};
}

}  // namespace

std::string Experiment::Parts::torque_unit() const {
  if (arm) return "1";
  std::string const& recorded = train.recordings.empty() ? std::string() : train.recordings.front().torque_unit;
  return in_torque_unit(regressor->joint() == JointKind::revolute ? "N m" : "N", recorded);
}

bool Experiment::Parts::rolls_out() const {
  return std::any_of(estimators.begin(), estimators.end(), [](EstimatorPlan const& one) { return one.rolls_out(); });
}

std::vector<std::string> Experiment::Parts::parameter_units() const {
  if (arm) return arm->model.units();
  std::vector<std::string> units = rollout ? rollout->units : regressor->units();
  for (auto& unit : units) unit = in_torque_unit(unit, torque_unit());
  return units;
}

void Experiment::forget_motion() {
  parts_->train.regression.forget_motion();
  if (parts_->validate) parts_->validate->regression.forget_motion();
}

void Experiment::forget_reductions() { parts_->reductions = {}; }

std::string const& Experiment::name() const { return parts_->experiment.name; }

std::uint64_t Experiment::seed() const { return static_cast<std::uint64_t>(parts_->experiment.seed); }

std::filesystem::path Experiment::output_file() const {
  return parts_->output.file.empty() ? std::filesystem::path(name() + ".h5")
                                     : std::filesystem::path(parts_->output.file);
}

std::string Experiment::inputs_sha256() const {
  Digest digest;
  digest.text(parts_->job.sha256);
  for (auto const& recording : parts_->train.recordings) digest.text(recording.sha256);
  if (parts_->validate)
    for (auto const& recording : parts_->validate->recordings) digest.text(recording.sha256);
  if (parts_->arm) digest.text(parts_->arm->sha256);
  for (auto const& plan : parts_->estimators)
    if (!plan.start.empty()) digest.numbers(plan.start);
  return digest.hex();
}

std::string vector_target() { return std::string(kernels::instruction_set()); }

std::string Experiment::job_line() const {
  std::vector<std::string> labels;
  std::size_t runs = 0;
  for (auto const& plan : parts_->estimators) {
    labels.push_back(plan.label);
    runs += runs_of(plan, parts_->experiment);
  }
  return fmt::format("{}: {}, {}; {}; {}", name(), counted(parts_->joints(), "joint"),
                     counted(parts_->parameters(), "parameter"), fmt::join(labels, ", "), counted(runs, "run"));
}

std::vector<std::string> Experiment::fitness_lines() const {
  std::vector<std::string> lines;
  for (auto const& plan : parts_->estimators)
    if (!plan.is_closed_form())
      lines.push_back(fmt::format("{} from {}", plan.label, fitness_choice(*parts_, plan).words));
  return lines;
}

std::int64_t evaluations_of(Experiment::Parts const& parts, EstimatorPlan const& plan) {
  auto const members = static_cast<std::int64_t>(plan.make_optimiser(parts.box, {})->largest_batch());
  std::int64_t const each = (plan.stop_rules.generations + 1) * members;
  return parts.experiment.runs * (plan.stop_rules.evaluations > 0 ? std::min(each, plan.stop_rules.evaluations) : each);
}

FitnessChoice fitness_choice(Experiment::Parts const& parts, EstimatorPlan const& plan) {
  if (plan.objective.precision == "float32") return single_precision_choice(plan.objective, *parts.single_precision);
  return choose_fitness(plan.objective, parts.train.regression.parameters(), evaluations_of(parts, plan),
                        parts.statistics ? &*parts.statistics : nullptr);
}

std::string Experiment::diagnose_line() const {
  return fmt::format("{}: {}, {}; {}, {}", name(), counted(parts_->joints(), "joint"),
                     counted(parts_->parameters(), "parameter"), counted(parts_->effects.size(), "effect"),
                     counted(static_cast<std::size_t>(parts_->diagnose.replicates), "replicate"));
}

std::string Experiment::data_line() const {
  auto const& recordings = parts_->train.recordings;
  std::string line = recordings.size() == 1 ? recordings.front().name : counted(recordings.size(), "recording");
  line += fmt::format(", {} samples, {:.4g} s at {:.6g} Hz", samples_of(parts_->train), seconds_of(parts_->train),
                      recordings.front().rate_hz);
  if (parts_->filter.cutoff_hz > 0.0) line += fmt::format("; cutoff {:.4g} Hz", parts_->filter.cutoff_hz);
  if (parts_->validate) line += fmt::format("; validation {:.4g} s", seconds_of(*parts_->validate));
  return line;
}

namespace {

// empty for the whole method
std::string ablation_words(LevelOptions const& options) {
  auto const ablations = options.changed();
  if (ablations.empty()) return {};
  return fmt::format("an ablation ({}): it shows what a part of the method brings; believe no name it gives",
                     fmt::join(ablations, ", "));
}

}  // namespace

std::string Experiment::filter_warning() const {
  FilterOptions const& filter = parts_->filter;
  double const parallel_hz = parallel_cutoff_of(filter);
  if (std::string words = ruin_words(filter, parts_->motion_hz, parts_->noise_hz); !words.empty()) return words;
  if (!(filter.cutoff_hz > 0.0) || parallel_hz <= filter.cutoff_hz) return {};
  return fmt::format(
      "parallel_cutoff_hz = {:g} is above cutoff_hz = {:g}: between the two the torque keeps what the motion has lost, "
      "and what the "
      "model cannot follow there looks like missing physics; set parallel_cutoff_hz = {:.3g}, half of cutoff_hz, or "
      "raise cutoff_hz",
      parallel_hz, filter.cutoff_hz, 0.5 * filter.cutoff_hz);
}

bool Experiment::asks_for_values() const { return !parts_->estimators.empty(); }

std::vector<std::string> Experiment::warnings() const {
  std::vector<std::string> lines;
  if (parts_->arm)
    for (auto const& warning : parts_->arm->model.chain().warnings) lines.push_back("robot: " + warning);
  for (auto const& finding : findings())
    if (finding.grade != Grade::note)
      lines.push_back(fmt::format("{}: {}", finding.recording, sentence_with_cure(finding)));
  auto const add = [&](DataSet const& set) {
    for (auto const& recording : set.recordings)
      for (auto const& warning : recording.warnings)
        lines.push_back(fmt::format("{}: {}: {}", recording.name, warning.topic, warning.text));
  };
  add(parts_->train);
  if (parts_->validate) add(*parts_->validate);
  if (asks_for_values() && !parts_->health.words.empty()) lines.push_back("regressor: " + parts_->health.words);
  if (std::string const words = filter_warning(); !words.empty()) lines.push_back("filter: " + words);
  if (std::string const words = ablation_words(parts_->levels); !words.empty()) lines.push_back("diagnose: " + words);
  return lines;
}

namespace {

// "stribeck of joint 2: stribeck_speed = 0.031 rad/s, stribeck_exponent = 1.9, refined in the fit"
std::string effect_words(HeldEffect const& held, JointKind kind) {
  std::string text = fmt::format("{} of joint {}", held.effect->name(), held.joint + 1);
  for (std::size_t k = 0; k < held.shape.size(); ++k) {
    auto const& parameter = held.effect->parameters()[held.effect->n_linear() + k];
    std::string const unit = parameter.unit_for(kind);
    text += fmt::format("{} {} = {:.4g}{}", k == 0 ? ":" : ",", parameter.name, held.shape[k],
                        unit == "1" ? "" : " " + unit);
  }
  if (!held.shape.empty()) text += ", refined in the fit";
  for (std::size_t const k : shapes_at_bounds(held))
    text += fmt::format("; {} ends at the bound of what is plausible", shape_name(held, k));
  return text;
}

}  // namespace

std::vector<std::string> Experiment::remarks() const {
  std::vector<std::string> lines;
  if (parts_->arm)
    for (auto const& remark : parts_->arm->model.chain().remarks) lines.push_back("robot: " + remark);
  for (auto const& finding : findings())
    if (finding.grade == Grade::note) lines.push_back(fmt::format("{}: {}", finding.recording, sentence_of(finding)));
  if (parts_->arm)
    for (auto const& effect : parts_->arm->model.effects())
      lines.push_back(effect_words(effect, parts_->arm->model.chain().joints[effect.joint].kind));
  if (parts_->filter_is_chosen)
    lines.push_back(fmt::format(
        "filter (no [filter]): cutoff_hz = {:g}, parallel_cutoff_hz = {:g}, decimate_to_hz = {:g}, chosen from {}",
        parts_->filter.cutoff_hz, parts_->filter.parallel_cutoff_hz, parts_->filter.decimate_to_hz,
        parts_->train.recordings.front().name));
  if (parts_->box_is_default)
    lines.push_back("search box (no [model.bounds]): " + box_words(parts_->parameter_names(), parts_->box));
  for (auto const& plan : parts_->estimators)
    if (!plan.start_words.empty()) lines.push_back(plan.start_words);
  // a verdict does not rest on single values: what no value can be trusted for is worth no warning there, and what
  // costs an interval nothing but width is in the interval
  std::string const& words = asks_for_values() ? parts_->health.remark : parts_->health.words;
  if (!words.empty()) lines.push_back("regressor: " + words);
  return lines;
}

std::vector<Finding> Experiment::findings() const {
  std::vector<Finding> all;
  auto const add = [&](DataSet const& set) {
    for (auto const& recording : set.recordings)
      all.insert(all.end(), recording.findings.begin(), recording.findings.end());
  };
  add(parts_->train);
  if (parts_->validate) add(*parts_->validate);
  return all;
}

std::vector<CheckLine> Experiment::check(int threads) const {
  using Level = CheckLine::Level;
  std::vector<CheckLine> lines;
  std::size_t keys = 0;
  for (auto const& section : parts_->job.sections) keys += section.settings.size();
  lines.push_back({Level::ok, "job", fmt::format("{}, none unknown", counted(keys, "key"))});

  if (parts_->arm) {
    auto const& chain = parts_->arm->model.chain();
    for (auto const& warning : chain.warnings) lines.push_back({Level::warn, "robot", warning});
    for (auto const& remark : chain.remarks) lines.push_back({Level::note, "robot", remark});
  }

  auto const add_set = [&](DataSet const& set, std::string const& purpose) {
    for (std::size_t k = 0; k < set.recordings.size(); ++k) {
      auto const& recording = set.recordings[k];
      lines.push_back(
          {Level::ok, purpose,
           fmt::format("{}: {} samples at {:.6g} Hz", recording.name, set.n_samples[k], recording.rate_hz)});
      if (k < set.accounts.size())
        for (auto const& account : set.accounts[k]) lines.push_back({Level::ok, "rows", account_words(account)});
      for (auto const& finding : recording.findings)
        lines.push_back({level_of(finding.grade), code_of(finding.kind), sentence_with_cure(finding)});
      for (auto const& warning : recording.warnings) lines.push_back({Level::warn, warning.topic, warning.text});
    }
  };
  add_set(parts_->train, "recording");
  if (parts_->validate) add_set(*parts_->validate, "unseen");

  if (std::string const words = filter_warning(); !words.empty()) lines.push_back({Level::warn, "filter", words});
  for (std::size_t k = 0; k < parts_->train.excitation.size(); ++k) {
    std::size_t const j = k % parts_->joints();
    std::string const whose = parts_->arm ? joint_title(j, parts_->arm->model.joint_names()) + ": " : std::string();
    JointKind const kind = parts_->arm ? parts_->arm->model.chain().joints[j].kind : parts_->regressor->joint();
    lines.push_back({Level::ok, "excitation", whose + excitation_words(parts_->train.excitation[k], kind)});
  }
  if (parts_->health.words.empty())
    lines.push_back({Level::ok, "separable",
                     fmt::format("condition number {:.3g}{}{}", parts_->health.condition_number,
                                 parts_->health.remark.empty() ? "" : "; ", parts_->health.remark)});
  else
    lines.push_back({Level::warn, "separable", parts_->health.words});

  if (parts_->arm) {
    auto const told = arm_identifiability(*parts_);
    lines.push_back({told.all_seen ? Level::ok : Level::warn, "identifiable", told.words});
    if (auto const wrench = wrench_account(*parts_); !wrench.words.empty())
      lines.push_back({wrench.explains ? Level::ok : Level::warn, "wrench", wrench.words});
  }

  if (parts_->rollout)
    for (auto const* data : {&parts_->rollout->train, &parts_->rollout->validate})
      for (std::size_t k = 0; k < data->tracks.size(); ++k)
        lines.push_back({Level::note, "loop", fmt::format("{}: {}", data->tracks[k].name, data->loop_words[k])});

  if (parts_->job.find("diagnose") != nullptr)
    lines.push_back({Level::ok, "diagnosis",
                     fmt::format("{}, {}", counted(parts_->effects.size(), "effect"),
                                 counted(static_cast<std::size_t>(parts_->diagnose.replicates), "replicate"))});
  if (parts_->job.find("diagnose") != nullptr || parts_->estimators.empty()) {
    auto const size = diagnosis_size(*parts_);
    lines.push_back({Level::ok, "diagnosis", estimate_words(size, estimate_diagnosis(size, threads))});
    if (auto const fewer = many_rows_warning(*parts_)) lines.push_back({Level::note, "diagnosis", *fewer});
  }
  if (std::string const words = ablation_words(parts_->levels); !words.empty())
    lines.push_back({Level::warn, "diagnosis", words});
  if (parts_->estimators.empty()) return lines;
  double evaluations = 0.0, bytes = 0.0;
  auto const parameters = static_cast<double>(parts_->parameters());
  for (auto const& plan : parts_->estimators) {
    if (plan.is_closed_form()) continue;
    auto const members = static_cast<double>(plan.make_optimiser(parts_->box, {})->largest_batch());
    auto const stored_generations =
        StoredGenerations::of(parts_->output.history, static_cast<std::size_t>(plan.stop_rules.generations)).value();
    evaluations += static_cast<double>(evaluations_of(*parts_, plan));
    double const stored = parts_->output.populations ? members * (parameters + 1.0) : 0.0;
    bytes += static_cast<double>(parts_->experiment.runs) * static_cast<double>(stored_generations.count()) *
             (stored + 7.0) * 8.0;
  }
  lines.push_back({Level::ok, "plan",
                   fmt::format("{}, {:.0f} evaluations at most, {:.3g} MB of history, {}",
                               counted(parts_->estimators.size(), "estimator"), evaluations, bytes / 1e6,
                               counted(static_cast<std::size_t>(threads), "thread"))});
  return lines;
}

}  // namespace torquescope
