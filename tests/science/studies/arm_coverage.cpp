// Do 95 % intervals of a whole arm hold the truth? 500 closed-loop records of jobs/crs_a465_five_joints.toml.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

#include "engine/store/result_reader.hpp"
#include "engine/workflows/workflows.hpp"
#include "support/temporary_folder.hpp"

namespace torquescope {
namespace {

namespace fs = std::filesystem;

constexpr int records = 500, first_seed = 1000;

void replace_all(std::string& text, std::string const& from, std::string const& to) {
  for (auto at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size()))
    text.replace(at, from.size(), to);
}

std::string job_with_seed(int seed) {
  fs::path const jobs = fs::path(TORQUESCOPE_SOURCE_DIR) / "jobs";
  std::string job = test::bytes_of(jobs / "crs_a465_five_joints.toml");
  replace_all(job, "\"robots/", "\"" + (jobs / "robots/").string());
  replace_all(job, "\"motions/", "\"" + (jobs / "motions/").string());
  replace_all(job, "validate = true", "validate = false");
  replace_all(job, "[[estimator]]\nname = \"ols\"\n", "");
  replace_all(job, "seed = 42", "seed = " + std::to_string(seed));
  return job + "\n[output]\nsamples = false\n";
}

TEST(IntervalsOfAnArm, HoldTheTruthAsOftenAsTheySay) {
  test::TemporaryFolder const folder;
  std::vector<std::string> names;
  std::vector<int> held;
  for (int k = 0; k < records; ++k) {
    IdentifyOptions options;
    options.threads = {1, "test"};
    options.output = folder / ("arm_" + std::to_string(k) + ".h5");
    identify(Experiment::load(folder.write("arm.toml", job_with_seed(first_seed + k))), options, ProgressSink{});
    ResultReader const result(options.output);
    auto const truth = result.numbers("/model/truth").values, interval = result.numbers("/runs/wls/ci95").values;
    names = result.texts("/model/names");
    held.resize(truth.size(), 0);
    for (std::size_t r = 0; r < truth.size(); ++r)
      held[r] += interval[2 * r] <= truth[r] && truth[r] <= interval[2 * r + 1];
    fs::remove(options.output);
  }
  // measured: 94.5 % overall, 91.8 to 97.4 by parameter; before hac_bias.hpp 92.2, 89.2 to 95.8
  double all = 0.0;
  double const chance = 3.0 * std::sqrt(0.95 * 0.05 / records);  // three binomial deviations of one parameter
  for (std::size_t r = 0; r < held.size(); ++r) {
    double const share = static_cast<double>(held[r]) / records;
    all += share / static_cast<double>(held.size());
    EXPECT_NEAR(share, 0.95, chance + 0.005) << names[r];
  }
  EXPECT_GE(all, 0.935);
  EXPECT_LE(all, 0.965);
}

}  // namespace
}  // namespace torquescope
