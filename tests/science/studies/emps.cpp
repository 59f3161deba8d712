// The real axis as a whole job: the published parameters and errors (Janot, Gautier, Brunot 2019) come out.
#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "engine/run/workflows.hpp"
#include "engine/store/result_reader.hpp"
#include "support/recordings_folder.hpp"
#include "support/temporary_folder.hpp"

namespace torquescope {
namespace {

namespace fs = std::filesystem;

// jobs/emps.toml, pointed at the recordings of this machine
std::string job_for(fs::path const& recordings) {
  std::string job = test::bytes_of(fs::path(TORQUESCOPE_SOURCE_DIR) / "jobs/emps.toml");
  std::string const published = "../../shared/recordings";
  for (auto at = job.find(published); at != std::string::npos; at = job.find(published))
    job.replace(at, published.size(), fs::absolute(recordings).lexically_normal().string());
  return job;
}

TEST(Emps, GivesThePublishedParametersAndErrors) {
  fs::path const recordings = test::recordings_folder();
  SKIP_WITHOUT(recordings / "emps/emps_train.csv.gz");
  test::TemporaryFolder const folder;
  IdentifyOptions options;
  options.threads = {2, "test"};
  options.output = folder / "emps.h5";
  identify(Experiment::load(folder.write("emps.toml", job_for(recordings))), options, ProgressSink{});

  ResultReader const result(options.output);
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
}

}  // namespace
}  // namespace torquescope
