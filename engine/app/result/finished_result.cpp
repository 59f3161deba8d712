#include "engine/app/result/finished_result.hpp"

#include <fmt/format.h>

#include <system_error>

#include "engine/app/result/result_summary.hpp"
#include "engine/base/error.hpp"

namespace torquescope {

namespace {

Error output_exists(std::filesystem::path const& output, std::string const& why, std::string const& more_help = "") {
  Problem problem;
  problem.code = ExitCode::exists;
  problem.what = fmt::format("{} exists and {}", output.string(), why);
  problem.help =
      fmt::format("--out another name, or delete {}{}{}", output.string(), more_help.empty() ? "" : "; ", more_help);
  return Error(problem);
}

}  // namespace

bool already_complete(std::filesystem::path const& output, std::string const& inputs_sha256, ResultKind kind,
                      std::filesystem::path const& continued) {
  std::error_code ignored;
  auto const status = std::filesystem::symlink_status(output, ignored);
  if (!std::filesystem::exists(status)) return false;
  if (std::filesystem::is_directory(status)) throw output_exists(output, "is a folder");
  ResultSummary made;
  try {
    made = read_summary(output);
  } catch (Error const& error) {
    if (error.code() == ExitCode::io) throw;
    throw output_exists(output, "is no complete result file: " + error.problems().front().what);
  }
  bool const is_other = made.inputs_sha256 != inputs_sha256;
  if (is_other && !continued.empty() && std::filesystem::equivalent(output, continued, ignored)) return false;
  if (is_other) {
    bool const could_go_on = kind == ResultKind::runs && !made.has_diagnosis;
    throw output_exists(output, "was made by another job, or from other recordings (sha256 differs)",
                        could_go_on ? "--continue " + output.string() + " when only stop rules changed" : "");
  }
  if (made.is_partial()) return false;  // its segments are there to make it whole
  bool const wants_diagnosis = kind == ResultKind::diagnosis;
  if (wants_diagnosis != made.has_diagnosis)
    throw output_exists(output, made.has_diagnosis ? "holds the diagnosis of this job, not its runs"
                                                   : "holds the runs of this job, not its diagnosis");
  return true;
}

}  // namespace torquescope
