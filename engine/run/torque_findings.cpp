#include "engine/run/torque_findings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "engine/problem/command_limit.hpp"
#include "engine/problem/torque_zero.hpp"
#include "engine/run/job_sections.hpp"

namespace torquescope {
namespace {

struct Asked {
  Experiment::Parts const& parts;
  std::string column, unit;
  Section filter;
  bool diagnoses;

  std::optional<TorqueBesideMotion> beside(Recording const& recording) const {
    return TorqueBesideMotion::of(recording, parts.filter, *parts.regressor, filter);
  }
  Finding finding(FindingKind kind, Repair repair, Recording const& recording) const {
    Finding one{kind, Grade::warning, repair, recording.name};
    one.column = column;
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

}  // namespace

void examine_torques(std::vector<Recording>& recordings, Experiment::Parts const& parts,
                     RecordingOptions const& options, Experiment::Purpose purpose) {
  auto const named = options.columns.find("torque");
  Asked const asked{parts, named != options.columns.end() ? named->second : "torque",
                    parts.regressor->joint() == JointKind::revolute ? "N m" : "N",
                    section_or_empty(parts.job, "filter"), purpose == Experiment::Purpose::diagnose};
  for (auto& recording : recordings) {
    auto const beside = asked.beside(recording);
    if (!beside) continue;
    auto const limit = command_limit(*beside, recording.torque);
    if (limit) limit_command(recording, *limit, asked);
    auto const beside_limit = limit ? asked.beside(recording) : std::nullopt;
    auto const zero = torque_zero(beside_limit ? *beside_limit : *beside, recording.time_s, recording.torque);
    if (zero) note_zero(recording, *zero, asked);
  }
}

std::optional<Finding> zero_finding(std::vector<Finding> const& findings) {
  auto const found = std::find_if(findings.begin(), findings.end(), [](Finding const& one) {
    return one.kind == FindingKind::torque_zero_steps || one.kind == FindingKind::torque_zero_drifts;
  });
  return found != findings.end() ? std::optional(*found) : std::nullopt;
}

}  // namespace torquescope
