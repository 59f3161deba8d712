#include "engine/experiment/arm_assembly.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <span>
#include <utility>

#include "engine/base/digest.hpp"
#include "engine/data/arm_recording.hpp"
#include "engine/data/filter_checks.hpp"
#include "engine/data/filter_suggestion.hpp"
#include "engine/data/health/joined_findings.hpp"
#include "engine/data/health/make_arm_recording.hpp"
#include "engine/diagnose/arms/effect_shapes.hpp"
#include "engine/experiment/arm_instruments.hpp"
#include "engine/experiment/arm_keys.hpp"
#include "engine/experiment/arm_wrench.hpp"
#include "engine/experiment/job_sections.hpp"
#include "engine/experiment/recordings_of_job.hpp"
#include "engine/experiment/sample_range.hpp"
#include "engine/experiment/simulated_arms.hpp"
#include "engine/experiment/torque_findings.hpp"
#include "engine/fit/problem/arm_regression.hpp"
#include "engine/fit/problem/recorded_arm.hpp"
#include "engine/fit/problem/recorded_rows.hpp"
#include "engine/infer/pipeline/arm_reversals.hpp"
#include "engine/robot/robot_registry.hpp"

namespace torquescope {
namespace {

using Eigen::Index;
using Joints = std::vector<Recording>;  // of one arm recording
using Files = std::vector<RecordedArm>;

// everything that decides the columns of a regressor, and what a result keeps of the robot beside it
std::string digest_of(SerialChain const& chain) {
  Digest digest;
  digest.numbers({chain.gravity.data(), 3});
  for (auto const& joint : chain.joints) {
    double const kind = joint.kind == JointKind::revolute ? 0.0 : 1.0;
    double const numbers[] = {kind, joint.a, joint.alpha, joint.d, joint.offset};
    double const beside[] = {joint.lower,      joint.upper,      joint.max_speed,     joint.max_acceleration,
                             joint.max_torque, joint.gear_ratio, joint.drive_inertia, joint.encoder_step};
    digest.text(joint.name).numbers(numbers).numbers(beside);
  }
  for (auto const& link : chain.links) {
    LinkVector const numbers = link.vector();
    digest.numbers({numbers.data(), static_cast<std::size_t>(numbers.size())});
  }
  if (chain.has_coupled_drives())
    digest.numbers({chain.transmission.data(), static_cast<std::size_t>(chain.transmission.size())});
  return digest.hex();
}

Files read_files(Job const& job, std::vector<std::string> const& files, RecordingOptions const& options,
                 CarriedPayloads const& payloads, std::vector<std::string> const& joint_names,
                 RecordedTables const& tables) {
  Section const section = section_or_empty(job, "recording");
  auto const of_joints = joint_options(options, joint_names, section);
  Files recordings;
  for (std::size_t k = 0; k < files.size(); ++k) {
    RawTable const table = table_of_job(job, files[k], section, tables);
    for (auto const& one : of_joints) refuse_huge_samples(table, one);
    recordings.push_back({make_arm_recording(table, of_joints, joint_names, section).joints, payloads[k],
                          read_wrench(table, of_joints.front(), section)});
  }
  return recordings;
}

// of the first estimator that needs instruments; nullptr: none does
Section const* instrumental_section(Experiment::Parts const& parts) {
  auto const sections = parts.job.all("estimator");
  for (std::size_t i = 0; i < parts.estimators.size(); ++i)
    if (parts.estimators[i].needs_instruments) return sections[i];
  return nullptr;
}

// columns of motors: each joint feels its own, and those that turn with it
void take_motor_torques(Joints& joints, SerialChain const& chain, RecordingOptions const& options) {
  if (options.torque_at != "motors" || !chain.has_coupled_drives()) return;
  Joints const motors = joints;
  for (std::size_t j = 0; j < joints.size(); ++j) {
    joints[j].torque.setZero();
    for (std::size_t m = 0; m < motors.size(); ++m) {
      double const turns = chain.transmission(static_cast<Index>(m), static_cast<Index>(j));
      joints[j].torque += turns * motors[m].torque;
      if (m == j || turns == 0.0) continue;
      // where a motor's torque is not known, that of no joint that feels it is
      for (auto const& stretch : motors[m].left_out_because)
        if (!stretch.of_motion) {
          joints[j].left_out.push_back(stretch.where);
          joints[j].left_out_because.push_back(stretch);
        }
    }
  }
}

void split_files(Files& train, Files& validation, double share) {
  if (share >= 1.0) return;
  for (auto& file : train) {
    RecordedArm tail{{}, file.payload};
    split_off_validation(file.joints, tail.joints, share);
    split_off_validation(file.wrench, tail.wrench, share);
    validation.push_back(std::move(tail));
  }
}

void bring_files_to_one_rate(Files& train, Files& validation) {
  Joints first_of_train, first_of_validation;
  for (auto const& file : train) first_of_train.push_back(file.joints.front());
  for (auto const& file : validation) first_of_validation.push_back(file.joints.front());
  double const rate_hz = rate_of_job(first_of_train, first_of_validation);
  for (auto* files : {&train, &validation})
    for (auto& file : *files) {
      bring_joints_to_rate(file.joints, rate_hz);
      bring_to_rate(file.wrench, rate_hz);
    }
}

// an arm of which no joint moves tells nothing; one joint that stands still is worth a warning
void grade_standstill(Joints& joints) {
  auto const stands = [](Finding const& finding) { return finding.kind == FindingKind::standstill; };
  bool const all_stand = std::all_of(joints.begin(), joints.end(), [&](Recording const& joint) {
    return std::any_of(joint.findings.begin(), joint.findings.end(), stands);
  });
  if (!all_stand) return;
  for (auto& joint : joints)
    for (auto& finding : joint.findings)
      if (stands(finding)) finding.grade = Grade::fault;
}

// Of the joints of a kind together; of slides and revolute joints the faster ones: what they keep, all keep
FilterSuggestion suggest_filter_of(SerialChain const& chain, Files const& train, Files const& validation) {
  double shortest_s = std::numeric_limits<double>::infinity();
  for (auto const* files : {&train, &validation})
    for (auto const& file : *files)
      shortest_s =
          std::min(shortest_s, static_cast<double>(file.joints.front().position.size()) / file.joints.front().rate_hz);
  FilterSuggestion best;
  for (auto const kind : {JointKind::revolute, JointKind::prismatic}) {
    Joints alike;
    for (std::size_t j = 0; j < chain.joints.size(); ++j)
      if (chain.joints[j].kind == kind) alike.push_back(train.front().joints[j]);
    if (alike.empty()) continue;
    FilterSuggestion const one = suggest_arm_filter(alike, shortest_s);
    if (one.options.cutoff_hz > best.options.cutoff_hz) best = one;
  }
  return best;
}

void choose_filter(Experiment::Parts& parts, Files const& train, Files const& validation) {
  FilterSuggestion const suggestion = suggest_filter_of(parts.arm->model.chain(), train, validation);
  if (parts.job.find("filter") == nullptr) {
    parts.filter = suggestion.options;
    parts.filter_is_chosen = true;
  }
  parts.motion_hz = suggestion.motion_hz;
  parts.noise_hz = suggestion.noise_hz;
}

// samples that tell of the set-up: the joint moves one way, and the job or a finding leaves none of them out
std::vector<std::vector<bool>> telling_samples(std::vector<std::vector<bool>> moves, std::vector<Motion> const& motion,
                                               FilterOptions const& filter) {
  for (std::size_t j = 0; j < motion.size(); ++j) {
    auto const left_out = left_out_samples(motion[j], parallel_cutoff_of(filter));
    for (std::size_t k = 0; k < left_out.size(); ++k)
      if (left_out[k]) moves[j][k] = false;
  }
  return moves;
}

// what the recordings say of their own set-up and time
struct SetupRows {
  ArmSamples samples{};
  LaggedGrams lagged{};
};

// one recording of the arm: its rows, and into `set` what is to be said about it; into `track`, if there is one, what
// its instruments are made from
RecordedRows prepare_recording(RecordedArm&& file, Experiment::Parts const& parts, DataSet& set, ArmTrack* track,
                               SetupRows* setup) {
  auto& joints = file.joints;
  Section const filter = section_or_empty(parts.job, "filter");
  auto const& model = parts.arm->model;
  auto const names = model.joint_names();
  Recording whole;
  whole.name = joints.front().name;
  whole.sha256 = joints.front().sha256;
  whole.rate_hz = joints.front().rate_hz;
  set.n_samples.push_back(static_cast<std::size_t>(joints.front().time_s.size()));
  std::vector<Motion> motion;
  if (track != nullptr) track->joints = joints;
  for (std::size_t j = 0; j < joints.size(); ++j) {
    auto& joint = joints[j];
    char const* const unit = model.chain().joints[j].kind == JointKind::revolute ? "rad" : "m";
    auto facts = measure_channels(joint);
    set.lone.push_back(joint.lone);
    whole.warnings.insert(whole.warnings.end(), joint.warnings.begin(), joint.warnings.end());
    whole.findings.insert(whole.findings.end(), joint.findings.begin(), joint.findings.end());
    motion.push_back(differentiate(std::move(joint), parts.filter, filter));
    measure_motion(motion.back(), parts.filter, facts);
    for (auto& warning : excitation_warnings(facts, unit))
      whole.warnings.push_back({warning.topic, joint_title(j, names) + ": " + warning.text});
    set.excitation.push_back(facts);
  }
  auto const moves = samples_one_way(model, motion, parallel_cutoff_of(parts.filter));
  if (track != nullptr) track->moves = moves;
  constexpr Index most_samples = 1200;
  if (setup != nullptr && !file.payload)
    setup->samples.add(motion, telling_samples(moves, motion, parts.filter), edge_samples(parts.filter, whole.rate_hz),
                       most_samples, file.outside);
  whole.findings = joined_findings(whole.findings);
  auto rows = make_recorded_rows(whole.name, motion, moves, parts.filter, model, filter, file.payload);
  if (setup != nullptr && model.gain_columns().empty())
    setup->lagged.add(model, motion, rows, ParallelFilter(parts.filter, rows.rate_hz, motion.front().q.size(), filter));
  set.recordings.push_back(std::move(whole));
  set.accounts.push_back(rows.accounts);
  for (std::size_t j = 0; j < names.size(); ++j) set.accounts.back()[j].joint = joint_title(j, names);
  return rows;
}

std::vector<RecordedRows> prepare_files(Files&& files, Experiment::Parts const& parts, DataSet& set,
                                        std::vector<ArmTrack>* tracks = nullptr, SetupRows* setup = nullptr) {
  std::vector<RecordedRows> rows;
  for (auto& file : files) {
    ArmTrack* const track = tracks != nullptr ? &tracks->emplace_back() : nullptr;
    rows.push_back(prepare_recording(std::move(file), parts, set, track, setup));
  }
  return rows;
}

// an estimator that simulates what the arm was asked to do must be told what that was
void require_references(Experiment::Parts const& parts, Files const& train) {
  auto const is_there = [](Recording const& joint) { return joint.reference.size() > 0; };
  std::vector<Problem> problems;
  for (auto const& file : train)
    if (!std::all_of(file.joints.begin(), file.joints.end(), is_there))
      problems.push_back(problem_at(*instrumental_section(parts), "name",
                                    file.joints.front().name + " has no commanded positions: iv has no instruments",
                                    "name them in recording.columns, as reference = \"q_ref{j}_rad\"; without them use "
                                    "wls"));
  if (!problems.empty()) throw Error(std::move(problems));
}

void stack(std::vector<RecordedRows> const& rows, Experiment::Parts const& parts, DataSet& set) {
  Section const filter = section_or_empty(parts.job, "filter");
  auto const of = [&](ArmRowChoice choice) {
    return stack_rows(rows, choice, parts.arm->model, parts.arm->noise.deviation, filter);
  };
  set.regression = of(ArmRowChoice::moving);
  set.other_rows = of(ArmRowChoice::others);
}

void use_recordings(Experiment::Parts& parts, Files&& train, Files&& validation) {
  auto& model = parts.arm->model;
  if (!model.effects().empty()) {
    ArmFilter const filter{parts.filter, section_or_empty(parts.job, "filter")};
    model = model.with_effects(refined_effects(model, train, filter));
  }
  if (parts.arm->keeps_channels) {
    parts.arm->train = train;
    parts.arm->validate = validation;
  }
  std::vector<ArmTrack> tracks;
  bool const is_instrumental = instrumental_section(parts) != nullptr;
  if (is_instrumental) require_references(parts, train);
  SetupRows setup;
  auto const rows = prepare_files(std::move(train), parts, parts.train, is_instrumental ? &tracks : nullptr, &setup);
  parts.arm->samples = std::move(setup.samples);
  parts.arm->lagged = std::move(setup.lagged);
  parts.arm->grams = filtered_grams(rows, parts.arm->model);
  parts.arm->noise = noise_levels(parts.arm->grams, static_cast<Eigen::Index>(parts.parameters()));
  stack(rows, parts, parts.train);
  if (is_instrumental)
    parts.train.regression.arm->instruments = instruments_of(
        std::move(tracks),
        {parts.arm->model, parts.filter, section_or_empty(parts.job, "filter"), parts.arm->noise.deviation});
  if (validation.empty()) return;
  parts.validate.emplace();
  stack(prepare_files(std::move(validation), parts, *parts.validate), parts, *parts.validate);
}

}  // namespace

ArmParts read_arm(Job const& job, ModelOptions const& options, std::vector<Payload> const& payloads) {
  SerialChain chain = read_robot(job.resolve(options.robot), {options.root, options.tip});
  auto otherwise = read_robot_otherwise(job.resolve(options.robot));
  if (!options.gravity.empty()) {
    validate(options.gravity.size() == 3, [&] {
      return problem_at(section_or_empty(job, "model"), "gravity",
                        fmt::format("gravity has {} numbers, not 3", options.gravity.size()),
                        "write x, y and z in the base frame: gravity = [0, 0, -9.81]");
    });
    chain.gravity = chain.base.rotation.transpose() * Eigen::Vector3d::Map(options.gravity.data());
  }
  ArmTerms terms{options.friction};
  chain.transmission = read_joint_models(job, chain.joints.size(), terms);
  terms.drives = options.drive_inertia ? DriveInertias::included : DriveInertias::left_out;
  terms.velocity_deadband = options.velocity_deadband;
  terms.payloads = payloads;
  terms.drive_gains = options.drive_gains;
  terms.effects = read_arm_effects(job, chain);
  std::string const sha256 = digest_of(chain);
  ArmParts arm{ArmModel(std::move(chain), terms, section_or_empty(job, "model")), options.robot, sha256};
  arm.otherwise = std::move(otherwise);
  return arm;
}

void use_arm_files(Experiment::Parts& parts, RecordingOptions const& options, PayloadPlan const& payloads,
                   RecordedTables const& tables, Experiment::Purpose purpose) {
  auto const names = parts.arm->model.joint_names();
  Files train = read_files(parts.job, options.train, options, payloads.train, names, tables);
  Files validation = read_files(parts.job, options.validate, options, payloads.validate, names, tables);
  split_files(train, validation, options.train_share);
  bring_files_to_one_rate(train, validation);
  for (auto* files : {&train, &validation})
    for (auto& file : *files) {
      take_motor_torques(file.joints, parts.arm->model.chain(), options);
      add_wrench(file, parts.arm->model.chain(), options);
    }
  for (auto& file : train) grade_standstill(file.joints);
  choose_filter(parts, train, validation);
  for (auto* files : {&train, &validation}) examine_arm_torques(*files, parts, options, purpose);
  use_recordings(parts, std::move(train), std::move(validation));
}

void use_arm_simulation(Experiment::Parts& parts, ArmSimulationPlan const& plan) {
  auto simulated = simulate_arms(plan, static_cast<std::uint64_t>(parts.experiment.seed));
  Files train, validation;
  train.push_back({std::move(simulated.train)});
  for (auto& joints : simulated.validate) validation.push_back({std::move(joints)});
  use_recordings(parts, std::move(train), std::move(validation));
  parts.train.simulated = true;
  if (parts.validate) parts.validate->simulated = true;
  // without drives the base parameters gather something else
  if (parts.arm->model.drives() == DriveInertias::left_out) return;
  auto const names = parts.parameter_names();
  for (std::size_t k = 0; k < names.size(); ++k)
    for (auto const& [name, value] : simulated.truth)
      if (name == names[k]) parts.truth[static_cast<Eigen::Index>(k)] = value;
}

}  // namespace torquescope
