#include "engine/experiment/torque_findings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/data/arm_recording.hpp"
#include "engine/experiment/job_sections.hpp"
#include "engine/fit/problem/command_limit.hpp"
#include "engine/fit/problem/computed_torque.hpp"
#include "engine/fit/problem/torque_zero.hpp"

namespace torquescope {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

// one joint's torque column, and what is asked of it
struct Asked {
  std::string column, reference, unit, joint;
  bool diagnoses;

  Finding finding(FindingKind kind, Repair repair, Recording const& recording) const {
    Finding one{kind, Grade::warning, repair, recording.name};
    one.column = column;
    one.joint = joint;
    return one;
  }
};

std::string limit_words(CommandLimit const& limit, std::string const& unit) {
  constexpr double alike = 0.02;  // of the level: one limit for both directions
  if (!limit.lower) return fmt::format("more than {:.3g} {}", *limit.upper, unit);
  if (!limit.upper) return fmt::format("less than {:.3g} {}", *limit.lower, unit);
  double const mean = 0.5 * (*limit.upper - *limit.lower);
  if (std::fabs(*limit.upper + *limit.lower) <= 2.0 * alike * mean)
    return fmt::format("more than {:.3g} {} either way", mean, unit);
  return fmt::format("more than {:.3g} {}, or less than {:.3g} {}", *limit.upper, unit, *limit.lower, unit);
}

void limit_command(Recording& recording, CommandLimit const& limit, Asked const& asked) {
  auto finding = asked.finding(FindingKind::command_beyond_limit, Repair::none, recording);
  if (asked.diagnoses) finding.grade = Grade::fault;
  finding.count = limit.rows;
  finding.size = static_cast<double>(limit.rows) / static_cast<double>(recording.torque.size());
  finding.detail = limit_words(limit, asked.unit);
  finding.error_before = limit.error_before;
  finding.error_after = limit.error_after;
  recording.torque = limited(recording.torque, limit);
  recording.rows.torque_limit_share = std::max(recording.rows.torque_limit_share, finding.size);
  recording.findings.push_back(std::move(finding));
}

void note_zero(Recording& recording, TorqueZero const& zero, Asked const& asked) {
  bool const corrects = !asked.diagnoses, steps = zero.change == ZeroChange::step;
  auto finding = asked.finding(steps ? FindingKind::torque_zero_steps : FindingKind::torque_zero_drifts,
                               corrects ? Repair::corrected : Repair::none, recording);
  finding.size = zero.size;
  finding.error_before = zero.explained;
  auto const& rows = recording.rows;
  bool const stands_on_rows = rows.resampled == 0 && rows.repeated == 0 && rows.missing == 0;
  if (steps) {
    finding.detail = fmt::format("{:.4g} s{}", zero.time_s,
                                 stands_on_rows ? fmt::format(" (row {})", zero.sample + 1) : std::string());
  }
  finding.unit = asked.unit;
  if (corrects) recording.torque -= zero_error(zero, recording.time_s);
  recording.findings.push_back(std::move(finding));
}

void note_computed(Recording& recording, ComputedTorque const& computed, Asked const& asked) {
  auto finding = asked.finding(FindingKind::torque_computed, Repair::none, recording);
  if (asked.diagnoses) finding.grade = Grade::fault;
  finding.detail = asked.reference;
  finding.error_before = computed.error_of_motion;
  finding.error_after = computed.error_of_reference;
  recording.findings.push_back(std::move(finding));
}

void note_smoothness(Recording& recording, Asked const& asked) {
  auto finding = asked.finding(FindingKind::torque_computed, Repair::none, recording);
  finding.grade = Grade::note;
  recording.findings.push_back(std::move(finding));
}

std::string column_of(RecordingOptions const& options, std::string const& channel) {
  auto const named = options.columns.find(channel);
  return named != options.columns.end() ? named->second : channel;
}

// single rows far from their neighbours are no command: the mean of these in their place
VectorXd without_lone_rows(Recording const& recording, std::string const& column) {
  VectorXd torque = recording.torque;
  for (auto const& lone : recording.lone) {
    if (lone.column != column) continue;
    auto const i = static_cast<Eigen::Index>(std::llround((lone.time_s - recording.time_s[0]) * recording.rate_hz));
    if (i > 0 && i + 1 < torque.size()) torque[i] = 0.5 * (recording.torque[i - 1] + recording.torque[i + 1]);
  }
  return torque;
}

void examine_levels(Recording& recording, TorqueBesideMotion const& as_recorded, Asked const& asked) {
  VectorXd const torque = without_lone_rows(recording, asked.column);
  TorqueBesideMotion const beside = as_recorded.with(torque);
  auto const limit = command_limit(beside, torque);
  if (limit) limit_command(recording, *limit, asked);
  VectorXd const given = limit ? limited(torque, *limit) : torque;
  auto const zero = torque_zero(limit ? beside.with(given) : beside, recording.time_s, given);
  if (zero) note_zero(recording, *zero, asked);
}

// of one recording: of a joint, or of all joints of an arm
void examine_joints(std::vector<Recording>& joints, std::vector<Asked> const& asked, BesideOfJoints const& measured,
                    BesidePositions const& beside) {
  std::vector<bool> was_computed(joints.size(), false);
  for (auto const& one : computed_torques(joints, measured, beside)) {
    note_computed(joints[one.joint], one, asked[one.joint]);
    was_computed[one.joint] = true;
  }
  for (std::size_t j = 0; j < joints.size(); ++j)
    if (!was_computed[j] && carries_no_noise(joints[j])) note_smoothness(joints[j], asked[j]);
  for (std::size_t j = 0; j < joints.size(); ++j)
    if (measured[j] && !was_computed[j]) examine_levels(joints[j], *measured[j], asked[j]);
}

Recording moved_along(Recording const& recording, VectorXd const& position) {
  Recording moved;
  moved.rate_hz = recording.rate_hz;
  moved.time_s = recording.time_s;
  moved.position = position;
  moved.torque = recording.torque;
  moved.left_out = recording.left_out;
  moved.left_out_because = recording.left_out_because;
  moved.rows = recording.rows;
  return moved;
}

std::vector<Recording> moved_along(std::vector<Recording> const& joints, std::vector<VectorXd> const& positions) {
  std::vector<Recording> moved;
  for (std::size_t j = 0; j < joints.size(); ++j) moved.push_back(moved_along(joints[j], positions[j]));
  return moved;
}

// Columns of gains are torques themselves
MatrixXd without_gains(MatrixXd const& columns, ArmModel const& model, std::size_t joint) {
  auto const& own = model.parameters_of(joint);
  auto const& gains = model.gain_columns();
  std::vector<Eigen::Index> kept;
  for (std::size_t k = 0; k < own.size(); ++k)
    if (std::find(gains.begin(), gains.end(), own[k]) == gains.end()) kept.push_back(static_cast<Eigen::Index>(k));
  return columns(Eigen::all, kept);
}

BesideOfJoints beside_arm(std::vector<Recording> const& joints, std::optional<std::size_t> payload,
                          Experiment::Parts const& parts) {
  Section const filter = section_or_empty(parts.job, "filter");
  auto const& model = parts.arm->model;
  std::vector<Motion> motion;
  std::vector<Stretch> left_out;  // where a joint's motion is not known, no other one's torque is
  for (auto const& joint : joints) {
    motion.push_back(differentiate(joint, parts.filter, filter));
    left_out.insert(left_out.end(), joint.left_out.begin(), joint.left_out.end());
  }
  auto const columns = model.rows(motion, payload);
  BesideOfJoints beside;
  for (std::size_t j = 0; j < joints.size(); ++j) {
    motion[j].left_out = left_out;
    if (payload) motion[j].torque -= model.known_torque(j, columns[j], *payload);
    beside.push_back(TorqueBesideMotion::of(motion[j], without_gains(columns[j], model, j), parts.filter, filter));
  }
  return beside;
}

}  // namespace

void examine_torques(std::vector<Recording>& recordings, Experiment::Parts const& parts,
                     RecordingOptions const& options, Experiment::Purpose purpose) {
  Asked const asked{column_of(options, "torque"), column_of(options, "reference"),
                    parts.regressor->joint() == JointKind::revolute ? "N m" : "N", "",
                    purpose == Experiment::Purpose::diagnose};
  Section const filter = section_or_empty(parts.job, "filter");
  auto const beside = [&](std::vector<Recording> const& joints) {
    return BesideOfJoints{TorqueBesideMotion::of(joints.front(), parts.filter, *parts.regressor, filter)};
  };
  for (auto& recording : recordings) {
    std::vector<Recording> joints{std::move(recording)};
    examine_joints(joints, {asked}, beside(joints),
                   [&](std::vector<VectorXd> const& positions) { return beside(moved_along(joints, positions)); });
    recording = std::move(joints.front());
  }
}

void examine_arm_torques(std::vector<RecordedArm>& files, Experiment::Parts const& parts,
                         RecordingOptions const& options, Experiment::Purpose purpose) {
  auto const names = parts.arm->model.joint_names();
  auto const of_joints = joint_options(options, names, section_or_empty(parts.job, "recording"));
  std::vector<Asked> asked;
  for (std::size_t j = 0; j < names.size(); ++j)
    asked.push_back({column_of(of_joints[j], "torque"), column_of(of_joints[j], "reference"),
                     parts.arm->model.torque_unit(j), joint_title(j, names), purpose == Experiment::Purpose::diagnose});
  for (auto& file : files)
    examine_joints(file.joints, asked, beside_arm(file.joints, file.payload, parts),
                   [&](std::vector<VectorXd> const& positions) {
                     return beside_arm(moved_along(file.joints, positions), file.payload, parts);
                   });
}

bool is_computed(std::vector<Recording> const& recordings) {
  return std::any_of(recordings.begin(), recordings.end(), [](Recording const& recording) {
    return std::any_of(recording.findings.begin(), recording.findings.end(), [](Finding const& one) {
      return one.kind == FindingKind::torque_computed && one.grade != Grade::note;
    });
  });
}

std::optional<Finding> zero_finding(std::vector<Finding> const& findings) {
  auto const found = std::find_if(findings.begin(), findings.end(), [](Finding const& one) {
    return one.kind == FindingKind::torque_zero_steps || one.kind == FindingKind::torque_zero_drifts;
  });
  return found != findings.end() ? std::optional(*found) : std::nullopt;
}

}  // namespace torquescope
