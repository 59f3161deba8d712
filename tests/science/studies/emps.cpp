// The real axis as a whole job: the published parameters and errors (Janot, Gautier, Brunot 2019) come out.
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "engine/run/workflows.hpp"
#include "engine/store/result_reader.hpp"

namespace torquescope {
namespace {

namespace fs = std::filesystem;

fs::path recordings_folder() {
  if (char const* folder = std::getenv("TORQUESCOPE_RECORDINGS")) return folder;
  return fs::path(TORQUESCOPE_SOURCE_DIR) / "../shared/recordings";
}

// jobs/emps.toml, pointed at the recordings of this machine
fs::path job_for(fs::path const& recordings) {
  std::ifstream file(fs::path(TORQUESCOPE_SOURCE_DIR) / "jobs/emps.toml");
  std::stringstream text;
  text << file.rdbuf();
  std::string job = text.str();
  std::string const published = "../../shared/recordings";
  for (auto at = job.find(published); at != std::string::npos; at = job.find(published))
    job.replace(at, published.size(), fs::absolute(recordings).lexically_normal().string());
  fs::path const path = fs::temp_directory_path() / "torquescope_emps.toml";
  std::ofstream(path) << job;
  return path;
}

TEST(Emps, GivesThePublishedParametersAndErrors) {
  fs::path const recordings = recordings_folder();
  if (!fs::exists(recordings / "emps/emps_train.csv.gz"))
    GTEST_SKIP() << "no EMPS recording: set TORQUESCOPE_RECORDINGS (README, real recordings)";
  fs::path const output = fs::temp_directory_path() / "torquescope_emps.h5";
  fs::remove(output);
  IdentifyOptions options;
  options.threads = {2, "test"};
  options.output = output;
  identify(Experiment::load(job_for(recordings)), options, ProgressSink{});

  ResultReader const result(output);
  auto const parameters = result.numbers("/runs/ols/parameters").values;
  EXPECT_NEAR(parameters[0], 95.1, 0.3);
  EXPECT_NEAR(parameters[1], 203.5, 0.5);
  EXPECT_NEAR(parameters[2], 20.4, 0.1);
  EXPECT_NEAR(parameters[3], -3.16, 0.03);
  double const train = result.attribute<double>("/runs/ols", "relerr_median");
  double const unseen = result.attribute<double>("/runs/ols", "validation_relerr_median");
  EXPECT_GE(train, 0.040);
  EXPECT_LE(train, 0.041);
  EXPECT_GE(unseen, 0.059);
  EXPECT_LE(unseen, 0.060);
  // the population methods find the same optimum
  for (std::string const label : {"de", "fade"})
    EXPECT_NEAR(result.attribute<double>("/runs/" + label, "relerr_median"), train, 1e-5) << label;
  fs::remove(output);
}

}  // namespace
}  // namespace torquescope
