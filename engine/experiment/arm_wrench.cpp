#include "engine/experiment/arm_wrench.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "engine/data/arm_recording.hpp"
#include "engine/data/health/make_recording.hpp"
#include "engine/diagnose/arms/wrench_reading.hpp"
#include "engine/experiment/job_sections.hpp"
#include "engine/robot/tip_wrench.hpp"

namespace torquescope {
namespace {

using Eigen::Index;

constexpr std::size_t wrench_columns = 6;

WrenchFrame other_of(WrenchFrame frame) { return frame == WrenchFrame::tip ? WrenchFrame::base : WrenchFrame::tip; }

// "12 to 1.3 % of joint 2" of the joint whose error changes most
std::string most_changed(Eigen::VectorXd const& before, Eigen::VectorXd const& after,
                         std::vector<std::string> const& names) {
  Index most = 0;
  (before - after).cwiseAbs().maxCoeff(&most);
  return fmt::format("{:.3g} to {:.2g} % of {}", 100.0 * before[most], 100.0 * after[most],
                     joint_title(static_cast<std::size_t>(most), names));
}

char const* other_word(std::string const& word) {
  if (word == "tip") return "base";
  if (word == "base") return "tip";
  return word == "arm" ? "surroundings" : "arm";
}

bool has_samples(Experiment::Parts const& parts) {
  constexpr Index fewest = 200;
  return parts.arm && parts.arm->samples.outside.rows() >= fewest;
}

// as the fit here knows it, whose frictions are those of single joints
WrenchFit wrench_fit(Experiment::Parts const& parts) {
  SerialChain chain = parts.arm->model.chain();
  chain.transmission.resize(0, 0);
  return fit_wrench(parts.arm->samples, chain);
}

}  // namespace

void check_wrench(Job const& job, RecordingOptions const& options, std::vector<EstimatorPlan> const& plans,
                  bool has_drive_gains, std::vector<Problem>& problems) {
  Section const section = section_or_empty(job, "recording");
  if (options.wrench.empty()) {
    for (auto const* key : {"wrench_frame", "wrench_on"})
      if (section.find(key) != nullptr)
        problems.push_back(problem_at(section, key, fmt::format("{} without wrench", key),
                                      "write wrench = [\"fx\", \"fy\", \"fz\", \"mx\", \"my\", \"mz\"], or remove it"));
    return;
  }
  if (options.wrench.size() != wrench_columns)
    problems.push_back(problem_at(section, "wrench", fmt::format("wrench has {} columns, not 6", options.wrench.size()),
                                  "name those of the force and of the moment: [\"fx\", \"fy\", \"fz\", \"mx\", \"my\", "
                                  "\"mz\"]"));
  if (has_drive_gains)
    problems.push_back(problem_at(section_or_empty(job, "model"), "drive_gains",
                                  "drive_gains beside recording.wrench: the gain is that of the motor's torque alone",
                                  "find the gains in recordings without a contact"));
  auto const sections = job.all("estimator");
  for (std::size_t i = 0; i < std::min(sections.size(), plans.size()); ++i)
    if (plans[i].needs_instruments)
      problems.push_back(problem_at(*sections[i], "name",
                                    fmt::format("{} simulates the arm without recording.wrench", plans[i].kind),
                                    "use wls"));
}

std::vector<Recording> read_wrench(RawTable const& table, RecordingOptions const& joint, Section const& section) {
  std::vector<Recording> wrench;
  std::vector<Problem> problems;
  for (auto const& column : joint.wrench) {
    RecordingOptions one = joint;
    one.columns["external_torque"] = column;
    Recording recording = make_recording(table, one, section);
    if (recording.external_torque.size() == 0)
      problems.push_back(problem_at(section, "wrench", fmt::format("no column \"{}\" in {}", column, recording.name),
                                    "every recording of the job needs the six columns of wrench"));
    std::erase_if(recording.left_out_because, [&](LeftOutStretch const& stretch) {
      bool const is_its_own = stretch.column == column || stretch.column.ends_with("/" + column);
      return stretch.reason != LeftOutReason::no_value || !is_its_own;
    });
    wrench.push_back(std::move(recording));
  }
  if (!problems.empty()) throw Error(std::move(problems));
  return wrench;
}

void add_wrench(RecordedArm& arm, SerialChain const& chain, RecordingOptions const& options) {
  if (arm.wrench.empty()) return;
  Index const n = arm.joints.front().position.size();
  Eigen::MatrixXd q(n, chain.size()), wrench(n, static_cast<Index>(wrench_columns));
  for (Index j = 0; j < chain.size(); ++j) q.col(j) = arm.joints[static_cast<std::size_t>(j)].position;
  for (std::size_t k = 0; k < wrench_columns; ++k) wrench.col(static_cast<Index>(k)) = arm.wrench[k].external_torque;
  if (options.wrench_on == "surroundings") wrench = -wrench;
  WrenchFrame const frame = options.wrench_frame == "tip" ? WrenchFrame::tip : WrenchFrame::base;
  arm.outside = {torques_of_wrench(chain, q, wrench, frame), torques_of_wrench(chain, q, wrench, other_of(frame))};
  for (std::size_t j = 0; j < arm.joints.size(); ++j) {
    Recording& joint = arm.joints[j];
    joint.torque += arm.outside.as_read.col(static_cast<Index>(j));
    for (auto const& column : arm.wrench)
      for (LeftOutStretch stretch : column.left_out_because) {
        stretch.of_motion = false;
        joint.left_out.push_back(stretch.where);
        joint.left_out_because.push_back(std::move(stretch));
      }
  }
  arm.wrench.clear();
}

WrenchAccount wrench_account(Experiment::Parts const& parts) {
  if (!has_samples(parts)) return {};
  WrenchFit const fit = wrench_fit(parts);
  bool const explains = fit.as_written.sum() <= fit.without.sum();
  return {explains, fmt::format("what the arm leaves of the torque (held-out blocks) {} from {} by the wrench",
                                explains ? "falls" : "changes",
                                most_changed(fit.without, fit.as_written, parts.arm->model.joint_names()))};
}

std::vector<Finding> wrench_findings(Experiment::Parts const& parts, RecordingOptions const& options) {
  if (!has_samples(parts)) return {};
  WrenchFit const fit = wrench_fit(parts);
  Finding finding{FindingKind::arm_setup, Grade::fault};
  finding.recording = parts.train.recordings.front().name;
  finding.count = 1;
  bool const other_side = fit.best == WrenchReading::other_side || fit.best == WrenchReading::other_side_and_frame;
  bool const other_frame = fit.best == WrenchReading::other_frame || fit.best == WrenchReading::other_side_and_frame;
  std::vector<std::string> what, lines;
  if (other_side) {
    what.emplace_back("has the other sign");
    lines.push_back(fmt::format("wrench_on = \"{}\"", other_word(options.wrench_on)));
  }
  if (other_frame) {
    what.push_back(fmt::format("is along the axes of the {}", other_word(options.wrench_frame)));
    lines.push_back(fmt::format("wrench_frame = \"{}\"", other_word(options.wrench_frame)));
  }
  if (what.empty()) return {};
  finding.detail = fmt::format("the wrench {} (error on held-out blocks: {})", fmt::join(what, " and "),
                               most_changed(fit.as_written, fit.at_best, parts.arm->model.joint_names()));
  finding.line_to_write = fmt::format("{}", fmt::join(lines, "   "));
  return {finding};
}

}  // namespace torquescope
