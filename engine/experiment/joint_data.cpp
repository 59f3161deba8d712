#include "engine/experiment/joint_data.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include "engine/data/filter_checks.hpp"
#include "engine/data/filter_suggestion.hpp"
#include "engine/data/health/make_recording.hpp"
#include "engine/data/row_account.hpp"
#include "engine/experiment/foreign_file.hpp"
#include "engine/experiment/job_sections.hpp"
#include "engine/experiment/recordings_of_job.hpp"
#include "engine/experiment/sample_range.hpp"
#include "engine/experiment/servo_rollouts.hpp"
#include "engine/experiment/simulated_recordings.hpp"
#include "engine/fit/problem/position_factor.hpp"

namespace torquescope {
namespace {

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

}  // namespace

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
  std::vector<Recording> validation =
      read_recordings(parts.job, options.validate, options, section, tables, OtherJoints::ignored);
  require_inputs(parts.job, options, parts.train.recordings, validation);
  split_off_validation(parts.train.recordings, validation, options.train_share);
  double const rate_hz = rate_of_job(parts.train.recordings, validation);
  bring_to_rate(parts.train.recordings, rate_hz);
  bring_to_rate(validation, rate_hz);
  grade_standstill(parts.train.recordings, Grade::fault);
  if (!validation.empty()) parts.validate = DataSet{std::move(validation), {}, {}, false};
}

ServoJob use_recording_set(Experiment::Parts& parts) {
  ServoJob servo = read_servo_job(parts.job);
  ServoSources sources = servo_sources(servo);
  parts.train.recordings = std::move(sources.train);
  if (!sources.validate.empty()) parts.validate = DataSet{std::move(sources.validate), {}, {}, false};
  return servo;
}

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

}  // namespace torquescope
