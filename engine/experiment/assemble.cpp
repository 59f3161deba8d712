// From a job file to an Experiment: every name becomes an object, every problem of the job is told at once.

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <optional>
#include <utility>

#include "engine/base/stack_limit.hpp"
#include "engine/experiment/arm_assembly.hpp"
#include "engine/experiment/arm_findings.hpp"
#include "engine/experiment/arm_keys.hpp"
#include "engine/experiment/arm_payloads.hpp"
#include "engine/experiment/arm_wrench.hpp"
#include "engine/experiment/fit_findings.hpp"
#include "engine/experiment/foreign_file.hpp"
#include "engine/experiment/job_checks.hpp"
#include "engine/experiment/job_sections.hpp"
#include "engine/experiment/joint_data.hpp"
#include "engine/experiment/rollout_parts.hpp"
#include "engine/experiment/search_box.hpp"
#include "engine/experiment/servo_rollouts.hpp"
#include "engine/experiment/setup_findings.hpp"
#include "engine/experiment/simulated_arms.hpp"
#include "engine/experiment/simulated_recordings.hpp"
#include "engine/experiment/start_point.hpp"
#include "engine/experiment/torque_findings.hpp"

namespace torquescope {

namespace {

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

// what the text of a job says beside what Parts holds
struct JobPlan {
  RecordingOptions recording{};
  bool simulates = false;
  PayloadPlan payloads{};
  SimulationPlan simulation{};
  ArmSimulationPlan arm_simulation{};
};

void read_arm_model(Experiment::Parts& parts, ModelOptions const& model, JobPlan& plan, Experiment::Purpose purpose,
                    std::vector<Problem>& problems) {
  Job const& job = parts.job;
  refuse_joint_keys(job, problems);
  plan.payloads = plan_payloads(job, plan.recording, model.drive_gains, problems);
  parts.arm = read_arm(job, model, plan.payloads.payloads);
  refuse_useless_payloads(parts, problems);
  refuse_motor_torques(job, plan.recording, parts.arm->model.chain(), problems);
  check_wrench(job, plan.recording, parts.estimators, model.drive_gains, problems);
  parts.arm->keeps_channels = purpose == Experiment::Purpose::diagnose;
  choose_arm_effects(parts, problems);
}

// the model, of a joint or of an arm, and what is searched for it; what it throws joins the other problems
void read_model(Experiment::Parts& parts, ModelOptions const& model, JobPlan& plan, Experiment::Purpose purpose,
                std::vector<Problem>& problems) {
  Section const diagnose = section_or_empty(parts.job, "diagnose");
  bool const is_arm = !model.robot.empty();
  try {
    if (is_arm) {
      read_arm_model(parts, model, plan, purpose, problems);
    } else {
      parts.regressor = make_regressor(model, section_or_empty(parts.job, "model"));
      parts.effects = chosen_effects(parts.diagnose, parts.regressor->joint(), model.terms, diagnose, problems);
    }
    if (is_arm)
      refuse_rollouts_of_arm(parts, problems);
    else
      begin_rollouts_of(parts, purpose, problems);
    parts.box = read_search_box(parts.parameter_names(), parts.job.find("model.bounds"), problems);
  } catch (Error const& error) {
    problems.insert(problems.end(), error.problems().begin(), error.problems().end());
  }
  if (!is_arm) refuse_arm_keys(parts.job, parts.estimators, problems);
  if (parts.arm && parts.arm->model.chain().has_coupled_drives())
    refuse_beside_coupled_drives(parts.job, parts.estimators, problems);
  if (parts.arm && !parts.arm->model.effects().empty()) refuse_beside_effects(parts.job, parts.estimators, problems);
}

// throws everything that the text alone can be refused for
JobPlan read_job_text(Experiment::Parts& parts, Experiment::Purpose purpose) {
  Job const& job = parts.job;
  std::vector<Problem> problems;
  check_section_names(job, problems);
  parts.experiment = read_options<ExperimentOptions>(job, problems);
  if (parts.experiment.name.empty()) parts.experiment.name = job.path.stem().string();
  check_name(job, parts.experiment.name, problems);
  parts.output = read_options<OutputOptions>(job, problems);
  check_history(job, parts.output, problems);
  parts.filter = read_options<FilterOptions>(job, problems);
  JobPlan plan;
  plan.recording = read_options<RecordingOptions>(job, problems);
  auto const model = read_options<ModelOptions>(job, problems);
  check_sources(job, plan.recording, purpose, problems);
  check_work(job, purpose, problems);
  parts.diagnose = read_options<DiagnoseOptions>(job, problems);
  parts.levels = read_options<LevelOptions>(job, problems);
  parts.estimators = plan_estimators(job.all("estimator"), problems);
  read_model(parts, model, plan, purpose, problems);
  plan.simulates = job.find("simulate") != nullptr;
  if (plan.simulates && parts.arm) plan.arm_simulation = plan_arm_simulation(job, parts.arm->model.chain(), problems);
  if (plan.simulates && parts.regressor) plan.simulation = plan_simulation(job, parts.regressor->joint(), problems);
  if (problems.empty()) check_sizes(parts, problems);
  if (!problems.empty()) throw Error(std::move(problems));
  return plan;
}

void use_joint_data(Experiment::Parts& parts, JobPlan const& plan, Experiment::Purpose purpose,
                    RecordedTables const& tables, Channels channels) {
  std::optional<ServoJob> servo;
  if (plan.simulates)
    use_simulation(parts, plan.simulation, channels);
  else if (has_recording_set(parts.job))
    servo = use_recording_set(parts);
  else
    use_files(parts, plan.recording, tables, channels);
  if (!plan.simulates) choose_filter(parts);
  if (!plan.simulates && !servo) {
    examine_torques(parts.train.recordings, parts, plan.recording, purpose);
    if (parts.validate) examine_torques(parts.validate->recordings, parts, plan.recording, purpose);
  }
  std::vector<Recording> train, validate;  // whole, for simulations: rows use the channels up
  if (parts.rollout && !servo) {
    train = parts.train.recordings;
    if (parts.validate) validate = parts.validate->recordings;
  }
  prepare(parts.train, parts, channels);
  if (parts.validate) prepare(*parts.validate, parts, channels);
  if (parts.rollout && servo)
    add_servo(*parts.rollout, *parts.regressor, *servo, parts.train.regression);
  else if (parts.rollout)
    add_recordings(*parts.rollout, *parts.regressor, std::move(train), std::move(validate), parts.train.regression,
                   parts.filter, section_or_empty(parts.job, "filter"));
}

// what the fit says of the recordings, to the findings of the first of them
void add_findings(Experiment::Parts& parts, RecordingOptions const& recording, Experiment::Purpose purpose) {
  bool const is_diagnosis = purpose == Experiment::Purpose::diagnose;
  auto found = parts.arm ? arm_findings(parts, recording) : fit_findings(parts, recording);
  // what is missing may bend an inertia below nothing: a diagnosis asks what it is
  if (parts.arm && is_diagnosis)
    for (auto& finding : found) finding.grade = std::min(finding.grade, Grade::warning);
  if (parts.arm)
    for (auto& finding : setup_findings(parts, recording, is_diagnosis ? SetupUse::diagnosis : SetupUse::fit))
      found.push_back(std::move(finding));
  auto& findings = parts.train.recordings.front().findings;
  findings.insert(findings.end(), found.begin(), found.end());
}

// where a search looks and begins, and the statistics that it evaluates
void prepare_searches(Experiment::Parts& parts, Experiment::Purpose purpose) {
  if (parts.job.find("model.bounds") == nullptr && searches(parts)) {
    parts.box = parts.rollout ? rollout_box(*parts.rollout->model) : box_from_recordings(parts);
    parts.box_is_default = true;
  }
  if (purpose != Experiment::Purpose::diagnose) set_starts(parts);
  if (purpose != Experiment::Purpose::identify) parts.reductions = {};
  if (purpose == Experiment::Purpose::identify && wants_statistics(parts))
    parts.statistics.emplace(parts.train.regression.phi, parts.train.regression.tau);
  check_precision(parts);
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
  JobPlan const plan = read_job_text(*parts, purpose);
  auto const n = static_cast<Eigen::Index>(parts->parameters());
  parts->truth = Eigen::VectorXd::Constant(n, std::numeric_limits<double>::quiet_NaN());
  bool const keeps_channels = purpose == Purpose::diagnose || purpose == Purpose::replay;
  auto const channels = keeps_channels ? Channels::kept : Channels::taken;
  if (parts->arm && plan.simulates)
    use_arm_simulation(*parts, plan.arm_simulation);
  else if (parts->arm)
    use_arm_files(*parts, plan.recording, plan.payloads, tables, purpose);
  else
    use_joint_data(*parts, plan, purpose, tables, channels);
  auto const& rows = parts->train.regression;
  if (!too_few_rows(rows)) parts->reductions = reductions_of(rows);
  parts->health = regressor_health(rows, parts->reductions);
  if (!plan.simulates) {
    add_findings(*parts, plan.recording, purpose);
    if (channels == Channels::taken && !parts->output.samples) parts->train.regression.forget_motion();
    if (purpose == Purpose::identify || purpose == Purpose::replay) refuse_faults(*parts, parts->job, plan.recording);
  }
  prepare_searches(*parts, purpose);
  return Experiment(std::move(parts));
}

}  // namespace torquescope
