// Real arms as whole jobs: the errors that jobs/panda.toml and jobs/ur10e.toml promise, on rows nobody has fitted.
#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

#include "engine/store/result_reader.hpp"
#include "engine/workflows/workflows.hpp"
#include "support/recordings_folder.hpp"
#include "support/temporary_folder.hpp"

namespace torquescope {
namespace {

namespace fs = std::filesystem;

void replace_all(std::string& text, std::string const& from, std::string const& to) {
  for (auto at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size()))
    text.replace(at, from.size(), to);
}

// a job of jobs/, pointed at the recordings and robots of this machine
std::string job_for(std::string const& name) {
  fs::path const jobs = fs::path(TORQUESCOPE_SOURCE_DIR) / "jobs";
  std::string job = test::bytes_of(jobs / name);
  replace_all(job, "../../shared/recordings", fs::absolute(test::recordings_folder()).lexically_normal().string());
  replace_all(job, "robots/", (jobs / "robots/").string());
  return job;
}

// relative error of wls on the validation rows that move one way, and on all
std::pair<double, double> validation_errors(std::string const& job) {
  test::TemporaryFolder const folder;
  IdentifyOptions options;
  options.threads = {2, "test"};
  options.output = folder / "arm.h5";
  identify(Experiment::load(folder.write("arm.toml", job)), options, ProgressSink{});
  ResultReader const result(options.output);
  return {result.attribute<double>("/runs/wls", "validation_relerr_median"),
          result.attribute<double>("/runs/wls", "validation_relerr_all_rows")};
}

TEST(Panda, LeavesLittleOfValidation) {
  SKIP_WITHOUT(test::recordings_folder() / "panda/panda_exciting_traj1.csv.gz");
  auto const [one_way, all] = validation_errors(job_for("panda.toml"));
  EXPECT_LE(one_way, 0.015);
  EXPECT_LE(all, 0.02);
}

// the job without its [filter], up to the next section
std::string without_filter(std::string job) {
  auto const from = job.find("[filter]"), to = job.find("\n[", from);
  return job.erase(from, to + 1 - from);
}

TEST(Panda, LeavesAsLittleWithTheFilterThatTheRecordingAsksFor) {
  SKIP_WITHOUT(test::recordings_folder() / "panda/panda_exciting_traj1.csv.gz");
  EXPECT_LE(validation_errors(without_filter(job_for("panda.toml"))).first, 0.015);
}

TEST(Ur10e, LeavesAsLittleWithTheFilterThatTheRecordingAsksFor) {
  SKIP_WITHOUT(test::recordings_folder() / "ur10e/ident_20_02_05_20sec_8harm.csv.gz");
  EXPECT_LE(validation_errors(without_filter(job_for("ur10e.toml"))).first, 0.047);
}

TEST(Ur10e, LeavesLittleOfValidationWhicheverRecordingIsLeftOut) {
  SKIP_WITHOUT(test::recordings_folder() / "ur10e/ident_20_02_05_20sec_8harm.csv.gz");
  std::string const a = "ident_20_02_05_20sec_8harm", b = "ident_20_02_10_30sec_12harm",
                    c = "ident_20_02_12_40sec_12harm";
  for (auto const& left_out : {a, b, c}) {
    std::string job = job_for("ur10e.toml");
    // the job leaves out the third: trade places with it
    replace_all(job, left_out, "LEFT_OUT");
    replace_all(job, c, left_out == c ? "LEFT_OUT" : left_out);
    replace_all(job, "LEFT_OUT", c);
    auto const [one_way, all] = validation_errors(job);
    EXPECT_LE(one_way, 0.047) << left_out;
    EXPECT_LE(all, 0.08) << left_out;
    EXPECT_GE(all, one_way) << left_out;
  }
}

}  // namespace
}  // namespace torquescope
