#include "engine/experiment/recordings_of_job.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "engine/data/change_of_rate.hpp"
#include "engine/data/split_recording.hpp"
#include "engine/experiment/job_sections.hpp"

namespace torquescope {

RawTable table_of_job(Job const& job, std::string const& name, Section const& section, RecordedTables const& tables) {
  auto const in_memory = tables.find(name);
  return in_memory != tables.end() ? in_memory->second : read_table(job.resolve(name), section);
}

double rate_of_job(std::vector<Recording> const& train, std::vector<Recording> const& validate) {
  constexpr double about_the_same = 0.1;
  double const first = train.front().rate_hz;
  double lowest = first, highest = first;
  for (auto const* recordings : {&train, &validate})
    for (auto const& recording : *recordings) {
      lowest = std::min(lowest, recording.rate_hz);
      highest = std::max(highest, recording.rate_hz);
    }
  return highest <= (1.0 + about_the_same) * lowest ? first : lowest;
}

namespace {

// a warning where anything had to change
std::optional<DataWarning> brought_to_rate(Recording& recording, double rate_hz) {
  double const own = recording.rate_hz;
  if (std::fabs(own - rate_hz) <= 1e-6 * rate_hz) return std::nullopt;
  recording = at_rate(std::move(recording), rate_hz);
  return DataWarning{"rate", fmt::format("sampled at {:.6g} Hz, resampled to the {:.6g} Hz of the job", own, rate_hz)};
}

}  // namespace

void bring_to_rate(std::vector<Recording>& recordings, double rate_hz) {
  for (auto& recording : recordings)
    if (auto const warning = brought_to_rate(recording, rate_hz)) recording.warnings.push_back(*warning);
}

void bring_joints_to_rate(std::vector<Recording>& joints, double rate_hz) {
  std::optional<DataWarning> warning;
  for (auto& joint : joints) warning = brought_to_rate(joint, rate_hz);
  if (warning) joints.front().warnings.push_back(*warning);
}

void require_inputs(Job const& job, RecordingOptions const& options, std::vector<Recording> const& train,
                    std::vector<Recording> const& validation) {
  std::vector<Problem> problems;
  auto const check = [&](char const* channel, Eigen::VectorXd Recording::*values) {
    auto const column = options.columns.find(channel);
    auto const has_it = [&](Recording const& one) { return (one.*values).size() > 0; };
    if (column == options.columns.end() || std::any_of(train.begin(), train.end(), has_it) ||
        std::any_of(validation.begin(), validation.end(), has_it))
      return;
    problems.push_back(problem_at(section_or_empty(job, "recording"), "columns",
                                  fmt::format("no recording has the column \"{}\" ({})", column->second, channel),
                                  "write its name as one of the files has it, or remove it"));
  };
  check("added_command", &Recording::added_command);
  check("external_torque", &Recording::external_torque);
  check("enabled", &Recording::enabled);
  if (!problems.empty()) throw Error(std::move(problems));
}

void split_off_validation(std::vector<Recording>& train, std::vector<Recording>& validation, double share) {
  if (share >= 1.0) return;
  for (auto& recording : train) {
    auto [head, tail] = split_recording(recording, share);
    recording = std::move(head);
    validation.push_back(std::move(tail));
  }
}

}  // namespace torquescope
