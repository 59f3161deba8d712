#include "engine/experiment/setup_findings.hpp"

#include <fmt/format.h>

#include <cmath>

#include "engine/data/arm_recording.hpp"
#include "engine/diagnose/arms/link_change.hpp"
#include "engine/diagnose/arms/setup_search.hpp"
#include "engine/diagnose/arms/tip_touch.hpp"
#include "engine/experiment/arm_wrench.hpp"

namespace torquescope {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

// "12 to 1.7 %" of the joint that gains most
std::string gain_words(VectorXd const& before, VectorXd const& after, std::vector<std::string> const& names) {
  Index gains_most = 0;
  (before.array() / after.array().max(SetupFit::floor)).maxCoeff(&gains_most);
  return fmt::format("{} {:.3g} to {:.2g} %", joint_title(static_cast<std::size_t>(gains_most), names),
                     100.0 * before[gains_most], 100.0 * after[gains_most]);
}

std::string what(SetupChange const& change, std::vector<std::string> const& names) {
  auto const title = [&](Index joint) { return joint_title(static_cast<std::size_t>(joint), names); };
  std::string const joint = change.joint >= 0 ? title(change.joint) : "all joints";
  std::string const other = change.other >= 0 ? title(change.other) : "";
  switch (change.kind) {
    case SetupKind::joint_sign:
      return fmt::format("{} counts the other way round than the robot file, position and torque alike", joint);
    case SetupKind::torque_sign:
      return fmt::format("the torque of {} has the other sign", joint);
    case SetupKind::position_sign:
      return fmt::format("the position of {} has the other sign", joint);
    case SetupKind::joints_exchanged:
      return fmt::format("the columns of {} and {} are exchanged", joint, other);
    case SetupKind::positions_exchanged:
      return fmt::format("the positions of {} and {} are exchanged", joint, other);
    case SetupKind::torques_exchanged:
      return fmt::format("the torques of {} and {} are exchanged", joint, other);
    case SetupKind::dh_convention:
      return "the Denavit-Hartenberg numbers of the robot file are of the other convention";
    case SetupKind::gravity:
      return "gravity points another way than the robot file says";
    case SetupKind::no_gravity:
      return "gravity is not in this torque, though the robot file has masses: something took it away";
    case SetupKind::motor_side:
      return "the torques are those of the motors, before the gears of the robot file";
    case SetupKind::position_factor:
      return fmt::format("the position of {} is in another unit: times {:.4g}", joint, change.number);
    case SetupKind::torque_factor:
      return fmt::format("the torque of {} is {:.3g} times too {}", joint,
                         std::abs(change.number) > 1.0 ? std::abs(change.number) : 1.0 / std::abs(change.number),
                         std::abs(change.number) > 1.0 ? "small" : "large") +
             (change.number < 0.0 ? " and has the other sign" : "");
    case SetupKind::zero:
      break;
  }
  return fmt::format("the zero of {} lies {:.3g} rad beside that of the robot file", joint, -change.number);
}

std::string written_list(VectorXd const& numbers) {
  std::vector<std::string> texts;
  for (double const number : numbers) texts.push_back(fmt::format("{:.4g}", number == 0.0 ? 0.0 : number));
  return fmt::format("[{}]", fmt::join(texts, ", "));
}

// numbers of the job, one for each joint
VectorXd of_joints(std::vector<double> const& numbers, Index joints) {
  if (numbers.size() == 1) return VectorXd::Constant(joints, numbers.front());
  return VectorXd::Map(numbers.data(), joints);
}

// number of the joint, from 1, whose column each joint is given
VectorXd order_of(std::vector<double> const& written, std::vector<Index> const& taken) {
  VectorXd order(static_cast<Index>(taken.size()));
  for (std::size_t j = 0; j < taken.size(); ++j) {
    auto const from = static_cast<std::size_t>(taken[j]);
    order[static_cast<Index>(j)] = written.empty() ? static_cast<double>(from + 1) : written[from];
  }
  return order;
}

Finding finding_of(Experiment::Parts const& parts, FindingKind kind) {
  Finding finding{kind, Grade::warning};
  finding.recording = parts.train.recordings.front().name;
  return finding;
}

// samples beyond the positions and speeds that the robot file allows
void add_limits(Experiment::Parts const& parts, std::vector<Finding>& findings) {
  constexpr double slack = 0.05, few = 0.01;
  auto const& samples = parts.arm->samples;
  auto const& chain = parts.arm->model.chain();
  auto const names = parts.arm->model.joint_names();
  for (Index j = 0; j < chain.size(); ++j) {
    ChainJoint const& joint = chain.joints[static_cast<std::size_t>(j)];
    auto const q = samples.q.col(j).array(), dq = samples.dq.col(j).array();
    double const room = std::isfinite(joint.upper - joint.lower) ? slack * (joint.upper - joint.lower) : 0.0;
    double const beyond = (q < joint.lower - room || q > joint.upper + room).cast<double>().mean();
    double const too_fast = (dq.abs() > (1.0 + slack) * joint.max_speed).cast<double>().mean();
    if (std::max(beyond, too_fast) < few) continue;
    Finding finding = finding_of(parts, FindingKind::beyond_limits);
    finding.joint = joint_title(static_cast<std::size_t>(j), names);
    finding.size = std::max(beyond, too_fast);
    finding.detail = beyond >= too_fast
                         ? fmt::format("the limits of the robot file, {:.4g} to {:.4g}", joint.lower, joint.upper)
                         : fmt::format("the greatest speed in the robot file, {:.4g}", joint.max_speed);
    findings.push_back(std::move(finding));
  }
}

// as the searches here know it, whose frictions are those of single joints
SerialChain with_own_drives(SerialChain chain) {
  chain.transmission.resize(0, 0);
  return chain;
}

// a load picked up or let go on the way
void add_link_change(Experiment::Parts const& parts, std::vector<Finding>& findings) {
  auto const change = find_link_change(parts.arm->samples, with_own_drives(parts.arm->model.chain()));
  if (!change) return;
  Finding finding = finding_of(parts, FindingKind::arm_changes_at);
  if (change->recording < parts.train.recordings.size())
    finding.recording = parts.train.recordings[change->recording].name;
  finding.size = change->time_s;
  finding.detail =
      "error on held-out blocks: " + gain_words(change->before, change->after, parts.arm->model.joint_names());
  constexpr double beyond_s = 1.0;  // the last sample is left out too
  finding.line_to_write =
      fmt::format("leave_out = [[{:.4g}, {:.4g}]]", change->time_s, std::ceil(change->end_s + beyond_s));
  findings.push_back(std::move(finding));
}

// Torques that come late. To a fit they are noise of a few percent; a diagnosis would find physics for them
std::optional<Finding> late_torques(Experiment::Parts const& parts, RecordingOptions const& options, SetupUse use) {
  auto const late = find_torque_delays(parts.arm->lagged);
  if (late.empty()) return {};
  Finding finding = finding_of(parts, FindingKind::arm_setup);
  finding.grade = use == SetupUse::diagnosis ? Grade::fault : Grade::warning;
  finding.count = std::ssize(late);
  auto const names = parts.arm->model.joint_names();
  VectorXd delays = of_joints(options.delay_s, parts.arm->model.chain().size());
  constexpr double digits = 1e4;  // a tenth of a millisecond
  for (auto const& one : late) {
    if (!finding.detail.empty()) finding.detail += "; and ";
    finding.detail += fmt::format("the torque of {} comes {:.3g} ms {} (error on held-out blocks: {:.3g} to {:.2g} %)",
                                  joint_title(one.joint, names), 1e3 * std::abs(one.seconds),
                                  one.seconds > 0.0 ? "late" : "early", 100.0 * one.before, 100.0 * one.after);
    double& delay = delays[static_cast<Index>(one.joint)];
    delay = std::round(digits * (delay - one.seconds)) / digits;
  }
  finding.line_to_write = "delay_s = " + written_list(delays);
  return finding;
}

// no row of any joint stands for this time
void leave_out(RecordedArm& recording, double from_s, double until_s) {
  for (Recording& joint : recording.joints) {
    Stretch const where{from_s - joint.time_s[0], until_s - joint.time_s[0]};
    joint.left_out.push_back(where);
    joint.left_out_because.push_back({where, LeftOutReason::asked_for, {}, false});
  }
}

// A moment in which something pushes the last link. A diagnosis leaves it out
std::optional<Finding> touched_tip(Experiment::Parts& parts, SetupUse use) {
  auto const& rows = parts.train.regression;
  bool const can_tell = parts.health.identifiable && rows.arm && rows.arm->gain_column.empty();
  if (!can_tell) return {};
  auto const touch = find_tip_touch(rows, parts.train.other_rows, parts.arm->model.chain());
  if (!touch) return {};
  Finding finding = finding_of(parts, FindingKind::arm_touched);
  if (touch->file < parts.train.recordings.size()) finding.recording = parts.train.recordings[touch->file].name;
  auto const names = parts.arm->model.joint_names();
  std::vector<std::string> who;
  for (std::size_t const j : touch->joints) who.push_back(joint_title(j, names));
  finding.size = touch->from_s;
  finding.detail =
      fmt::format("to {:.1f} s something pushes the last link{}: {} feel it together", touch->until_s,
                  touch->force ? fmt::format(" with {:.2g} N", *touch->force) : std::string(), fmt::join(who, ", "));
  constexpr double beside_s = 0.2;  // what the filter smears
  double const from_s = std::max(touch->from_s - beside_s, 0.0), until_s = touch->until_s + beside_s;
  finding.line_to_write = fmt::format("leave_out = [[{:.4g}, {:.4g}]]", from_s, until_s);
  if (use == SetupUse::diagnosis && touch->file < parts.arm->train.size()) {
    leave_out(parts.arm->train[touch->file], from_s, until_s);
    finding.repair = Repair::left_out;
  }
  return finding;
}

// A file whose own masses leave less than this of every joint's torque is the file of this arm: it tells more than a
// guess of masses could, which is off by a third
bool file_explains(SetupStep const& step) {
  constexpr double most_left = 0.1;
  return step.after.maxCoeff() < most_left;
}

// about the gravity of the job
std::optional<SerialChain> chain_otherwise(ArmParts const& arm) {
  if (!arm.otherwise) return {};
  SerialChain chain = arm.otherwise->chain;
  chain.gravity = arm.model.chain().gravity;
  return chain;
}

}  // namespace

std::string setup_lines(ArmSetup const& setup, SerialChain const& chain, RecordingOptions const& options,
                        std::string const& otherwise) {
  Index const n = chain.size();
  ArmSetup const as_read = setup_as_read(chain);
  VectorXd const signs = of_joints(options.joint_sign, n), zeros = of_joints(options.zero, n),
                 torques = of_joints(options.torque_per_unit, n), delays = of_joints(options.delay_s, n);
  VectorXd sign(n), zero(n), torque(n), delay(n);
  for (Index j = 0; j < n; ++j) {
    Index const p = setup.position_of[static_cast<std::size_t>(j)], t = setup.torque_of[static_cast<std::size_t>(j)];
    sign[j] = setup.position_factor[j] < 0.0 ? -signs[p] : signs[p];
    zero[j] = setup.position_factor[j] * zeros[p] + setup.zero[j];
    delay[j] = delays[t];
    torque[j] = setup.torque_factor[j] * signs[t] * torques[t] * sign[j];
  }
  std::vector<std::string> lines;
  if (setup.position_of != as_read.position_of)
    lines.push_back("position_order = " + written_list(order_of(options.position_order, setup.position_of)));
  if (setup.torque_of != as_read.torque_of)
    lines.push_back("torque_order = " + written_list(order_of(options.torque_order, setup.torque_of)));
  if (sign != signs) lines.push_back("joint_sign = " + written_list(sign));
  if (zero != zeros) lines.push_back("zero = " + written_list(zero));
  if (torque != torques) lines.push_back("torque_per_unit = " + written_list(torque));
  if (delay != delays) lines.push_back("delay_s = " + written_list(delay));
  VectorXd const units = setup.position_factor.cwiseAbs();
  if (units.minCoeff() != 1.0 || units.maxCoeff() != 1.0)
    lines.push_back(units.minCoeff() == units.maxCoeff()
                        ? fmt::format("position_per_unit = {:.10g}", units[0] * options.position_per_unit)
                        : "bring all position columns into one unit");
  if (setup.chain.gravity != chain.gravity) {
    Eigen::Vector3d const gravity = setup.chain.base.rotation * setup.chain.gravity;
    lines.push_back("[model] gravity = " + written_list((gravity.array().abs() < 1e-9).select(0.0, gravity)));
  }
  if (setup.is_of_other_convention)
    lines.push_back(fmt::format("convention = \"{}\" in [robot] of the robot file", otherwise));
  return fmt::format("{}", fmt::join(lines, "   "));
}

std::vector<Finding> setup_findings(Experiment::Parts& parts, RecordingOptions const& options, SetupUse use) {
  std::vector<Finding> findings;
  auto const& arm = *parts.arm;
  constexpr Index fewest = 200;
  if (arm.samples.size() < fewest) return findings;
  add_limits(parts, findings);
  // a wrench of another sign or frame looks like all other mistakes
  if (auto wrong = wrench_findings(parts, options); !wrong.empty()) {
    findings.push_back(std::move(wrong.front()));
    return findings;
  }
  SetupSearch const found = search_setup(arm.samples, with_own_drives(arm.model.chain()), chain_otherwise(arm));
  if (found.steps.empty()) {
    if (auto late = late_torques(parts, options, use))
      findings.push_back(std::move(*late));
    else if (auto touched = touched_tip(parts, use))
      findings.push_back(std::move(*touched));
    else
      add_link_change(parts, findings);
    return findings;
  }
  Finding finding = finding_of(parts, FindingKind::arm_setup);
  auto const names = arm.model.joint_names();
  for (auto const& step : found.steps) {
    if (!finding.detail.empty()) finding.detail += "; and ";
    finding.detail += what(step.change, names);
    finding.detail +=
        step.is_told_by_file ? " (error of the robot file's own masses: " : " (error on held-out blocks: ";
    finding.detail += gain_words(step.before, step.after, names) + ")";
    if (!step.is_told_by_file || (use == SetupUse::diagnosis && file_explains(step))) finding.grade = Grade::fault;
    ++finding.count;
  }
  finding.line_to_write =
      setup_lines(found.setup, arm.model.chain(), options, arm.otherwise ? arm.otherwise->name : "");
  findings.push_back(std::move(finding));
  return findings;
}

}  // namespace torquescope
