#include "engine/data/health/make_arm_recording.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "engine/data/columns.hpp"
#include "engine/data/data_problem.hpp"
#include "engine/data/health/finding_text.hpp"
#include "engine/data/health/make_recording.hpp"

namespace torquescope {
namespace {

std::vector<Recording> read_joints(RawTable const& table, std::vector<RecordingOptions> const& options,
                                   Section const& section) {
  std::vector<Recording> joints;
  std::vector<Problem> problems;
  for (auto const& one : options) {
    try {
      joints.push_back(make_recording(table, one, section));
    } catch (Error const& error) {
      // the same key, wrong for every joint, is said once
      for (auto const& problem : error.problems()) {
        bool const is_new = std::none_of(problems.begin(), problems.end(),
                                         [&](Problem const& other) { return other.what == problem.what; });
        if (is_new) problems.push_back(problem);
      }
    }
  }
  if (!problems.empty()) throw Error(std::move(problems));
  return joints;
}

void check_clock(std::vector<Recording> const& joints, RawTable const& table,
                 std::vector<std::string> const& joint_names) {
  auto const& first = joints.front();
  for (std::size_t j = 1; j < joints.size(); ++j) {
    bool const same = joints[j].time_s.size() == first.time_s.size() && joints[j].rate_hz == first.rate_hz &&
                      joints[j].time_s == first.time_s;
    validate(same, [&] {
      return bad_data(
          fmt::format("{} and {} of {} have no one clock: {} samples at {:.6g} Hz and {} samples at {:.6g} Hz",
                      joint_title(0, joint_names), joint_title(j, joint_names), file_name(table), first.time_s.size(),
                      first.rate_hz, joints[j].time_s.size(), joints[j].rate_hz),
          table.path, 0, "give every joint a value in every row, or cut the rows that some joints lack");
    });
  }
}

bool says_the_same(Finding const& a, Finding const& b) {
  return a.kind == b.kind && a.column == b.column && sentence_of(a) == sentence_of(b);
}

// whether every joint has it: then it is no joint's own
template <class Item, class Same>
bool is_shared(Item const& item, std::vector<Recording> const& joints, std::vector<Item> Recording::*list,
               Same const& same) {
  return joints.size() > 1 && std::all_of(joints.begin(), joints.end(), [&](Recording const& joint) {
           auto const& items = joint.*list;
           return std::any_of(items.begin(), items.end(), [&](Item const& other) { return same(item, other); });
         });
}

// shared ones stay with the first joint; the others say whose they are
void name_findings(std::vector<Recording>& joints, std::vector<std::string> const& joint_names) {
  auto const all = joints;
  auto const same_warning = [](DataWarning const& a, DataWarning const& b) {
    return a.topic == b.topic && a.text == b.text;
  };
  for (std::size_t j = 0; j < joints.size(); ++j) {
    auto& joint = joints[j];
    std::string const title = joint_title(j, joint_names);
    std::erase_if(joint.findings, [&](Finding const& finding) {
      return finding.kind == FindingKind::other_joints_move ||
             (j > 0 && is_shared(finding, all, &Recording::findings, says_the_same));
    });
    for (auto& finding : joint.findings)
      if (!is_shared(finding, all, &Recording::findings, says_the_same)) finding.joint = title;
    std::erase_if(joint.warnings, [&](DataWarning const& warning) {
      return j > 0 && is_shared(warning, all, &Recording::warnings, same_warning);
    });
    for (auto& warning : joint.warnings)
      if (!is_shared(warning, all, &Recording::warnings, same_warning)) warning.text = title + ": " + warning.text;
  }
}

}  // namespace

ArmRecording make_arm_recording(RawTable const& table, std::vector<RecordingOptions> const& options,
                                std::vector<std::string> const& joint_names, Section const& section) {
  ArmRecording arm{file_name(table), table.sha256, read_joints(table, options, section)};
  check_clock(arm.joints, table, joint_names);
  name_findings(arm.joints, joint_names);
  return arm;
}

}  // namespace torquescope
