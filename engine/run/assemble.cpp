// From a job file to an Experiment: every name becomes an object, every problem of the job is told at once.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "engine/base/stack_limit.hpp"
#include "engine/data/filter_checks.hpp"
#include "engine/data/filter_suggestion.hpp"
#include "engine/data/row_account.hpp"
#include "engine/health/finding_text.hpp"
#include "engine/health/make_recording.hpp"
#include "engine/problem/position_factor.hpp"
#include "engine/run/arm_assembly.hpp"
#include "engine/run/arm_findings.hpp"
#include "engine/run/arm_keys.hpp"
#include "engine/run/arm_wrench.hpp"
#include "engine/run/experiment_parts.hpp"
#include "engine/run/fit_findings.hpp"
#include "engine/run/foreign_file.hpp"
#include "engine/run/job_sections.hpp"
#include "engine/run/recordings_of_job.hpp"
#include "engine/run/rollout_parts.hpp"
#include "engine/run/sample_range.hpp"
#include "engine/run/search_box.hpp"
#include "engine/run/servo_rollouts.hpp"
#include "engine/run/setup_findings.hpp"
#include "engine/run/simulated_arms.hpp"
#include "engine/run/simulated_recordings.hpp"
#include "engine/run/start_point.hpp"
#include "engine/run/torque_findings.hpp"

namespace torquescope {

namespace {

Problem missing(Job const& job, std::string what, std::string help) {
  Problem problem;
  problem.what = std::move(what);
  problem.place.file = job.path.string();
  problem.help = std::move(help);
  return problem;
}

// a job must have something to do
void check_work(Job const& job, Experiment::Purpose purpose, std::vector<Problem>& problems) {
  bool const needs_none = purpose == Experiment::Purpose::diagnose || purpose == Experiment::Purpose::replay;
  if (needs_none || !job.all("estimator").empty()) return;
  bool const diagnoses = job.find("diagnose") != nullptr;
  if (purpose == Experiment::Purpose::check && diagnoses) return;
  std::string help = "write [[estimator]] with name = \"ols\"";
  if (diagnoses) help += ", or run it with `torquescope diagnose`";
  if (purpose == Experiment::Purpose::check) help += ", or [diagnose] where it is for `torquescope diagnose`";
  problems.push_back(missing(job, "the job has no [[estimator]]", std::move(help)));
}

void check_name(Job const& job, std::string const& name, std::vector<Problem>& problems) {
  if (is_a_name(name)) return;
  auto const* section = job.find("experiment");
  if (section != nullptr)
    problems.push_back(problem_at(*section, "name", "the name of an experiment has no \"/\" and no control characters",
                                  "a path belongs into --out, or [output] file"));
}

void check_sources(Job const& job, RecordingOptions const& recording, Experiment::Purpose purpose,
                   std::vector<Problem>& problems) {
  bool const reads = !recording.train.empty();
  bool const simulates = job.find("simulate") != nullptr;
  if (Section const* set = job.find("recordings")) {
    if (purpose == Experiment::Purpose::identify || purpose == Experiment::Purpose::replay) return;
    problems.push_back(problem_at(*set, "", "this command works on recording.train, and the job has [[recordings]]",
                                  "write [recording] with train = [\"FILE.csv\"] in place of [[recordings]]"));
    return;
  }
  if (Section const* known = job.find("known"))
    problems.push_back(problem_at(*known, "", "[known] is about the recordings of [[recordings]], and there are none",
                                  "remove it, or write [[recordings]] with files = \"train/*.csv\""));
  if (!reads && !simulates)
    problems.push_back(missing(job, "the job has no data: neither recording.train nor [simulate]",
                               "write [recording] with train = \"FILE.csv\", or [simulate] with a plant"));
  if (reads && simulates)
    problems.push_back(problem_at(*job.find("simulate"), "", "the job has both recording.train and [simulate]",
                                  "remove one of them; `torquescope simulate` writes a recording that train can name"));
}

std::vector<Recording> read_recordings(Job const& job, std::vector<std::string> const& files,
                                       RecordingOptions const& options, Section const& section,
                                       RecordedTables const& tables, OtherJoints others) {
  std::vector<Recording> recordings;
  for (auto const& file : files) {
    RawTable const table = table_of_job(job, file, section, tables);
    refuse_huge_samples(table, options);
    recordings.push_back(make_recording(table, options, section, others));
  }
  return recordings;
}

// what cannot be fitted: a joint that stands still tells nothing, in training
void grade_standstill(std::vector<Recording>& recordings, Grade grade) {
  for (auto& recording : recordings)
    for (auto& finding : recording.findings)
      if (finding.kind == FindingKind::standstill) finding.grade = grade;
}

// faults end a fit; a check lists them, and a diagnosis has a verdict for them
void refuse_faults(Experiment::Parts const& parts, Job const& job, RecordingOptions const& options) {
  std::vector<Problem> problems;
  auto const add = [&](std::vector<Recording> const& recordings, std::vector<std::string> const& files) {
    for (std::size_t k = 0; k < std::min(recordings.size(), files.size()); ++k)
      for (auto const& finding : recordings[k].findings)
        if (is_fault(finding)) problems.push_back(problem_of(finding, job.resolve(files[k]).string()));
  };
  add(parts.train.recordings, options.train);
  if (parts.validate) add(parts.validate->recordings, options.validate);
  if (!problems.empty()) throw Error(std::move(problems));
}

// a diagnosis looks at the channels again, a fit only at its rows
enum class Channels { kept, taken };

void use_simulation(Experiment::Parts& parts, SimulationPlan const& plan, Channels channels) {
  auto simulated = simulate_recordings(plan, static_cast<std::uint64_t>(parts.experiment.seed));
  auto const add_reference = [](Recording& recording) {
    if (recording.reference.size() == 0) recording.reference = recording.position;  // an exact motion
  };
  if (channels == Channels::kept) {
    add_reference(simulated.train);
    for (auto& recording : simulated.validate) add_reference(recording);
  }
  parts.train.simulated = true;
  parts.train.recordings.push_back(std::move(simulated.train));
  if (!simulated.validate.empty()) parts.validate = DataSet{std::move(simulated.validate), {}, {}, true};
  auto const names = parts.regressor->names();
  for (std::size_t i = 0; i < names.size(); ++i)
    for (auto const& [name, value] : simulated.truth)
      if (name == names[i]) parts.truth[static_cast<Eigen::Index>(i)] = value;
}

void use_files(Experiment::Parts& parts, RecordingOptions const& options, RecordedTables const& tables,
               Channels channels) {
  Section const section = section_or_empty(parts.job, "recording");
  auto const others = channels == Channels::kept ? OtherJoints::kept : OtherJoints::ignored;
  parts.train.recordings = read_recordings(parts.job, options.train, options, section, tables, others);
  std::vector<Recording> unseen =
      read_recordings(parts.job, options.validate, options, section, tables, OtherJoints::ignored);
  require_inputs(parts.job, options, parts.train.recordings, unseen);
  split_off_unseen(parts.train.recordings, unseen, options.train_share);
  double const rate_hz = rate_of_job(parts.train.recordings, unseen);
  bring_to_rate(parts.train.recordings, rate_hz);
  bring_to_rate(unseen, rate_hz);
  grade_standstill(parts.train.recordings, Grade::fault);
  if (!unseen.empty()) parts.validate = DataSet{std::move(unseen), {}, {}, false};
}

// servos: least squares see what the joint itself took, simulations what is known of each recording
ServoJob use_recording_set(Experiment::Parts& parts) {
  ServoJob servo = read_servo_job(parts.job);
  ServoSources sources = servo_sources(servo);
  parts.train.recordings = std::move(sources.train);
  if (!sources.validate.empty()) parts.validate = DataSet{std::move(sources.validate), {}, {}, false};
  return servo;
}

void forget_channels(Recording& recording) {
  for (auto* channel :
       {&recording.time_s, &recording.position, &recording.torque, &recording.reference, &recording.velocity,
        &recording.acceleration, &recording.simulated_torque, &recording.simulated_position, &recording.added_command,
        &recording.external_torque, &recording.enabled})
    *channel = Eigen::VectorXd();
}

// what a motion is made of, out of a recording that keeps its name, its warnings and whatever else stands in it
Recording taken_channels(Recording& recording) {
  Recording taken;
  taken.rate_hz = recording.rate_hz;
  taken.time_s = std::move(recording.time_s);
  taken.position = std::move(recording.position);
  taken.velocity = std::move(recording.velocity);
  taken.acceleration = std::move(recording.acceleration);
  taken.torque = std::move(recording.torque);
  taken.left_out = std::move(recording.left_out);
  taken.torque_unit = recording.torque_unit;
  taken.rows = recording.rows;
  taken.left_out_because = std::move(recording.left_out_because);
  return taken;
}

// least squares looks at turns as well
RowAccount account_of(Motion const& motion, FilterOptions const& options, Section const& section) {
  ParallelFilter const filter(options, motion.rate_hz, motion.q.size(), section);
  auto const stretch =
      stretch_of_samples(motion.left_out_because, motion.q.size(), motion.rate_hz, filter, parallel_cutoff_of(options));
  return row_account(motion.left_out_because, stretch, {}, motion.q.size(), filter);
}

// the rows of the fit, and what the motion can tell; excitation's warnings join those of the recording
void prepare(DataSet& set, Experiment::Parts const& parts, Channels channels) {
  Section const filter = section_or_empty(parts.job, "filter");
  char const* const unit = parts.regressor->joint() == JointKind::revolute ? "rad" : "m";
  // the motion of the rows is for the result file and its page
  auto const for_the_file = set.recordings.size() == 1 ? RowMotion::once : RowMotion::kept;
  // and of the question which unit the position has, where the model tells one
  bool const is_asked = parts.output.samples || (!set.simulated && tells_unit_of_position(*parts.regressor));
  auto const row_motion = channels == Channels::kept ? RowMotion::kept : is_asked ? for_the_file : RowMotion::used_up;
  for (auto& recording : set.recordings) {
    set.n_samples.push_back(static_cast<std::size_t>(recording.time_s.size()));
    auto facts = measure_channels(recording);
    Motion motion = channels == Channels::kept ? differentiate(recording, parts.filter, filter)
                                               : differentiate(taken_channels(recording), parts.filter, filter);
    if (channels == Channels::taken) forget_channels(recording);
    measure_motion(motion, parts.filter, facts);
    set.accounts.push_back({account_of(motion, parts.filter, filter)});
    set.lone.push_back(recording.lone);
    for (auto const& warning : excitation_warnings(facts, unit)) recording.warnings.push_back(warning);
    set.excitation.push_back(facts);
    append_rows(set.regression, recording.name, std::move(motion), parts.filter, *parts.regressor, filter, row_motion);
  }
}

// Of a job without [filter]: unfiltered, an encoder's steps differentiated twice drown the acceleration
void choose_filter(Experiment::Parts& parts) {
  double shortest_s = std::numeric_limits<double>::infinity();
  auto const look = [&](DataSet const& set) {
    for (auto const& one : set.recordings)
      shortest_s = std::min(shortest_s, static_cast<double>(one.position.size()) / one.rate_hz);
  };
  look(parts.train);
  if (parts.validate) look(*parts.validate);
  FilterSuggestion const suggestion = suggest_filter(parts.train.recordings.front(), shortest_s);
  if (parts.job.find("filter") == nullptr) {
    parts.filter = suggestion.options;
    parts.filter_is_chosen = true;
  }
  parts.motion_hz = suggestion.motion_hz;
  parts.noise_hz = suggestion.noise_hz;
}

bool searches(Experiment::Parts const& parts) {
  auto const& plans = parts.estimators;
  return std::any_of(plans.begin(), plans.end(), [](EstimatorPlan const& plan) { return !plan.is_closed_form(); });
}

bool wants_statistics(Experiment::Parts const& parts) {
  auto const& plans = parts.estimators;
  return std::any_of(plans.begin(), plans.end(), [&](EstimatorPlan const& plan) {
    return !plan.is_closed_form() &&
           wants_statistics(plan.objective, parts.train.regression.parameters(), evaluations_of(parts, plan));
  });
}

// the largest values that the options allow one by one overflow 64 bits together; doubles do not
void check_sizes(Experiment::Parts const& parts, std::vector<Problem>& problems) {
  constexpr double tebibyte = 0x1p40, most_tebibytes = 1024.0;
  constexpr double numbers_beside_members = 7.0;  // F, CR, PC, FC, best, gap, evaluations
  auto const sections = parts.job.all("estimator");
  for (std::size_t i = 0; i < parts.estimators.size(); ++i) {
    auto const& plan = parts.estimators[i];
    if (plan.is_closed_form()) continue;
    double const members =
        parts.output.populations ? static_cast<double>(plan.make_optimiser(parts.box, {})->largest_batch()) : 0.0;
    double const entries = static_cast<double>(plan.stop_rules.generations) + 1.0;
    double const numbers_per_member = static_cast<double>(parts.parameters()) + 1.0;
    double const numbers = members * numbers_per_member + numbers_beside_members;
    double const bytes = static_cast<double>(parts.experiment.runs) * entries * numbers * sizeof(double);
    if (bytes <= most_tebibytes * tebibyte) continue;
    problems.push_back(
        problem_at(*sections[i], "generations",
                   fmt::format("{} runs of {} generations are {:.3g} TiB of history; a job may have {}",
                               parts.experiment.runs, plan.stop_rules.generations, bytes / tebibyte, most_tebibytes),
                   "fewer generations, a smaller population, or fewer experiment.runs"));
  }
}

// float32 where its rounding would decide between candidates is refused, at the line that asks for it
void check_precision(Experiment::Parts& parts) {
  std::vector<Problem> problems;
  auto const sections = parts.job.all("estimator");
  for (std::size_t i = 0; i < sections.size(); ++i) {
    auto const& plan = parts.estimators[i];
    if (plan.is_closed_form() || plan.objective.precision != "float32") continue;
    if (!parts.single_precision)
      parts.single_precision = check_single_precision(parts.train.regression, *parts.statistics);
    auto const& check = *parts.single_precision;
    if (check.usable()) continue;
    std::string const why = std::isnan(check.noise)
                                ? parts.statistics->refusal()
                                : fmt::format("least squares leaves {:.1e} of the torque (float32 needs {:.0e})",
                                              check.noise, SinglePrecisionCheck::least_noise);
    problems.push_back(
        problem_at(*sections[i], "precision",
                   fmt::format("precision = \"float32\" {}: {}",
                               std::isnan(check.noise) ? "cannot be judged" : "on data without noise", why),
                   "its rounding would decide which candidate is better: remove precision"));
  }
  if (!problems.empty()) throw Error(std::move(problems));
}

// what is searched by rollouts, or replayed; sections that nobody uses are read all the same, for their mistakes
void begin_rollouts_of(Experiment::Parts& parts, Experiment::Purpose purpose, std::vector<Problem>& problems) {
  RolloutPlan plan = plan_rollouts(parts.job, *parts.regressor, problems);
  auto const& plans = parts.estimators;
  auto const rolls_out = [](EstimatorPlan const& one) { return one.rolls_out(); };
  bool const any = std::any_of(plans.begin(), plans.end(), rolls_out);
  if (!problems.empty() || purpose == Experiment::Purpose::diagnose || (!any && purpose != Experiment::Purpose::replay))
    return;
  parts.rollout = begin_rollouts(std::move(plan), *parts.regressor);
  bool const has_more = parts.parameters() > parts.row_parameters();
  if (!any || !has_more || purpose == Experiment::Purpose::replay) return;
  auto const sections = parts.job.all("estimator");
  for (std::size_t i = 0; i < std::min(sections.size(), plans.size()); ++i)
    if (!rolls_out(plans[i]))
      problems.push_back(
          problem_at(*sections[i], "name",
                     fmt::format("{} fits rows, which know nothing of effects and loops that are searched "
                                 "by rollouts",
                                 plans[i].label),
                     "give it a job of its own, or write fitness = \"rollout\""));
}

// an arm is not simulated joint by joint
void refuse_rollouts_of_arm(Experiment::Parts const& parts, std::vector<Problem>& problems) {
  char const* const help = "rollouts are of one joint: name its columns in a job with model.terms";
  for (char const* name : {"loop", "model.given"})
    if (Section const* section = parts.job.find(name))
      problems.push_back(problem_at(*section, "", fmt::format("[{}] in the job of an arm", name), help));
  auto const sections = parts.job.all("estimator");
  for (std::size_t i = 0; i < std::min(sections.size(), parts.estimators.size()); ++i)
    if (parts.estimators[i].rolls_out())
      problems.push_back(problem_at(
          *sections[i], parts.estimators[i].lm ? "name" : "fitness",
          fmt::format("{} simulates the recordings, and the job is about an arm", parts.estimators[i].label), help));
}

}  // namespace

Experiment::Experiment(std::unique_ptr<Parts> parts) : parts_(std::move(parts)) {}
Experiment::Experiment(Experiment&&) noexcept = default;
Experiment::~Experiment() = default;

Experiment Experiment::load(std::filesystem::path const& job_file, Purpose purpose) {
  return load(read_job_file(job_file), purpose);
}

Experiment Experiment::load(Job text, Purpose purpose, RecordedTables const& tables) {
  refuse_small_stack();
  auto parts = std::make_unique<Parts>();
  parts->job = std::move(text);
  Job const& job = parts->job;

  // everything the text alone can be refused for
  std::vector<Problem> problems;
  check_section_names(job, problems);
  parts->experiment = read_options<ExperimentOptions>(job, problems);
  if (parts->experiment.name.empty()) parts->experiment.name = job.path.stem().string();
  check_name(job, parts->experiment.name, problems);
  parts->output = read_options<OutputOptions>(job, problems);
  parts->filter = read_options<FilterOptions>(job, problems);
  auto const recording = read_options<RecordingOptions>(job, problems);
  auto const model = read_options<ModelOptions>(job, problems);
  bool const is_arm = !model.robot.empty();
  check_sources(job, recording, purpose, problems);
  check_work(job, purpose, problems);
  parts->diagnose = read_options<DiagnoseOptions>(job, problems);
  parts->estimators = plan_estimators(job.all("estimator"), problems);
  PayloadPlan payloads;
  try {
    if (is_arm) {
      refuse_joint_keys(job, problems);
      payloads = plan_payloads(job, recording, model.drive_gains, problems);
      parts->arm = read_arm(job, model, payloads.payloads);
      refuse_useless_payloads(*parts, problems);
      refuse_motor_torques(job, recording, parts->arm->model.chain(), problems);
      check_wrench(job, recording, parts->estimators, model.drive_gains, problems);
      parts->arm->keeps_channels = purpose == Purpose::diagnose;
      choose_arm_effects(*parts, problems);
    } else {
      parts->regressor = make_regressor(model, section_or_empty(job, "model"));
      parts->effects = chosen_effects(parts->diagnose, parts->regressor->joint(), model.terms,
                                      section_or_empty(job, "diagnose"), problems);
    }
    if (purpose == Purpose::diagnose)
      refuse_too_few_twins(parts->diagnose, parts->arm ? parts->arm->model.joints() : 1,
                           section_or_empty(job, "diagnose"), problems);
    if (is_arm)
      refuse_rollouts_of_arm(*parts, problems);
    else
      begin_rollouts_of(*parts, purpose, problems);
    parts->box = read_search_box(parts->parameter_names(), job.find("model.bounds"), problems);
  } catch (Error const& error) {
    problems.insert(problems.end(), error.problems().begin(), error.problems().end());
  }
  if (!is_arm) refuse_arm_keys(job, parts->estimators, problems);
  if (parts->arm && parts->arm->model.chain().has_coupled_drives())
    refuse_beside_coupled_drives(job, parts->estimators, problems);
  if (parts->arm && !parts->arm->model.laws().empty()) refuse_beside_laws(job, parts->estimators, problems);
  bool const simulates = job.find("simulate") != nullptr;
  SimulationPlan plan;
  ArmSimulationPlan arm_plan;
  if (simulates && parts->arm) arm_plan = plan_arm_simulation(job, parts->arm->model.chain(), problems);
  if (simulates && parts->regressor) plan = plan_simulation(job, parts->regressor->joint(), problems);
  if (problems.empty()) check_sizes(*parts, problems);
  if (!problems.empty()) throw Error(std::move(problems));

  // then the data
  auto const n = static_cast<Eigen::Index>(parts->parameters());
  parts->truth = Eigen::VectorXd::Constant(n, std::numeric_limits<double>::quiet_NaN());
  bool const keeps_channels = purpose == Purpose::diagnose || purpose == Purpose::replay;
  auto const channels = keeps_channels ? Channels::kept : Channels::taken;
  if (is_arm && simulates) {
    use_arm_simulation(*parts, arm_plan);
  } else if (is_arm) {
    use_arm_files(*parts, recording, payloads, tables, purpose);
  } else {
    std::optional<ServoJob> servo;
    if (simulates)
      use_simulation(*parts, plan, channels);
    else if (has_recording_set(job))
      servo = use_recording_set(*parts);
    else
      use_files(*parts, recording, tables, channels);
    if (!simulates) choose_filter(*parts);
    if (!simulates && !servo) {
      examine_torques(parts->train.recordings, *parts, recording, purpose);
      if (parts->validate) examine_torques(parts->validate->recordings, *parts, recording, purpose);
    }
    std::vector<Recording> train, validate;
    if (parts->rollout && !servo) {
      train = parts->train.recordings;
      if (parts->validate) validate = parts->validate->recordings;
    }
    prepare(parts->train, *parts, channels);
    if (parts->validate) prepare(*parts->validate, *parts, channels);
    if (parts->rollout && servo)
      add_servo(*parts->rollout, *parts->regressor, *servo, parts->train.regression);
    else if (parts->rollout)
      add_recordings(*parts->rollout, *parts->regressor, std::move(train), std::move(validate), parts->train.regression,
                     parts->filter, section_or_empty(job, "filter"));
  }
  auto const& rows = parts->train.regression;
  if (!too_few_rows(rows)) parts->reductions = reductions_of(rows);
  parts->health = regressor_health(rows, parts->reductions);
  if (!simulates) {
    auto found = is_arm ? arm_findings(*parts, recording) : fit_findings(*parts, recording);
    // what is missing may bend an inertia below nothing: a diagnosis asks what it is
    if (is_arm && purpose == Purpose::diagnose)
      for (auto& finding : found) finding.grade = std::min(finding.grade, Grade::warning);
    if (is_arm)
      for (auto& finding :
           setup_findings(*parts, recording, purpose == Purpose::diagnose ? SetupUse::diagnosis : SetupUse::fit))
        found.push_back(std::move(finding));
    auto& findings = parts->train.recordings.front().findings;
    findings.insert(findings.end(), found.begin(), found.end());
    if (channels == Channels::taken && !parts->output.samples) parts->train.regression.forget_motion();
    if (purpose == Purpose::identify || purpose == Purpose::replay) refuse_faults(*parts, job, recording);
  }
  if (job.find("model.bounds") == nullptr && searches(*parts)) {
    parts->box = parts->rollout ? rollout_box(*parts->rollout->model) : box_from_recordings(*parts);
    parts->box_is_default = true;
  }
  if (purpose != Purpose::diagnose) set_starts(*parts);
  if (purpose != Purpose::identify) parts->reductions = {};
  if (purpose == Purpose::identify && wants_statistics(*parts))
    parts->statistics.emplace(parts->train.regression.phi, parts->train.regression.tau);
  check_precision(*parts);
  return Experiment(std::move(parts));
}

}  // namespace torquescope
