// identify() stopped after any number of generations and begun again, divided into shards and merged: always the same
// file.

#include <gtest/gtest.h>

#include <atomic>
#include <utility>

#include "engine/base/error.hpp"
#include "engine/store/result_reader.hpp"
#include "engine/workflows/workflows.hpp"
#include "support/simulated_job.hpp"

namespace torquescope {
namespace resume_test {

namespace fs = std::filesystem;

std::string const job = test::joint_model + "[filter]\nedge_s = 0\n[model.bounds]\nevery = [-1, 1]\n" +
                        test::simulated_joint +
                        "[simulate.noise]\ntorque_std = 0.01\n[experiment]\nname = \"resume\"\nruns = 5\n"
                        "[[estimator]]\nname = \"ols\"\n"
                        "[[estimator]]\nname = \"de\"\npopulation = 8\ngenerations = 30\n"
                        "[[estimator]]\nname = \"fade\"\npopulation = 8\ngenerations = 40\nstagnation = 6\n"
                        "[[estimator]]\nname = \"jde\"\npopulation = 8\ngenerations = 30\n"
                        "[[estimator]]\nname = \"jade\"\npopulation = 8\ngenerations = 30\n"
                        "[[estimator]]\nname = \"lshade\"\npopulation = 9\ngenerations = 30\n"
                        "[[estimator]]\nname = \"cmaes\"\ngenerations = 30\n";

IdentifyOptions options_for(fs::path const& output, int threads) {
  IdentifyOptions options;
  options.threads = {threads, "test"};
  options.output = output;
  options.segment_seconds = 0.001;
  return options;
}

fs::path whole_result(test::TemporaryFolder const& folder) {
  fs::path const whole = folder / "whole.h5";
  IdentifyOptions options = options_for(whole, 1);
  options.segment_seconds = 1000.0;
  identify(test::load_job(job), options, {});
  return whole;
}

TEST(Identify, StoppedAnywhereAndBegunAgainWritesTheSameFile) {
  test::TemporaryFolder const folder;
  std::string const whole = test::bytes_of(whole_result(folder));
  // rarely of one thread, often of three: the other two pairs would take twice the time
  for (auto const& [threads, polls] : {std::pair{1, 173}, std::pair{3, 60}}) {
    fs::path const output = folder / "stopped.h5";
    int attempts = 0;
    for (bool done = false; !done; ++attempts) {
      ASSERT_LT(attempts, 1000);
      IdentifyOptions options = options_for(output, threads);
      std::atomic<int> polled{0};
      options.stop_requested = [&polled, most = polls] { return ++polled > most; };
      try {
        identify(test::load_job(job), options, {});
        done = true;
      } catch (Error const& error) {
        ASSERT_EQ(error.code(), ExitCode::stopped) << error.what();
        EXPECT_FALSE(fs::exists(output)) << "nothing half is published";
      }
    }
    EXPECT_GT(attempts, 1);
    EXPECT_TRUE(test::bytes_of(output) == whole) << threads << " threads, stopped every " << polls;
    EXPECT_FALSE(fs::exists(segment_folder_of(output)));
    fs::remove(output);
  }
}

TEST(Merge, OfAnyShardsWritesTheSameFile) {
  test::TemporaryFolder const folder;
  std::string const whole = test::bytes_of(whole_result(folder));
  for (std::size_t const count : {2u, 3u, 8u}) {  // of eight shards three have no run
    fs::path const output = folder / "merged.h5";
    for (std::size_t index = count; index-- > 0;) {
      IdentifyOptions options = options_for(output, 1 + static_cast<int>(index % 3));
      options.shard = {index, count, "test"};
      ShardReport const report = run_shard(test::load_job(job), options, {});
      EXPECT_EQ(report.runs_before, 0u);
    }
    JobStatus const status = read_status(segment_folder_of(output));
    ASSERT_EQ(status.estimators.size(), 6u);
    for (auto const& estimator : status.estimators) EXPECT_EQ(estimator.ended, 5);
    EXPECT_TRUE(status.unfinished_shares.empty());
    merge(test::load_job(job), options_for(output, 2), Completeness::whole, {});
    EXPECT_TRUE(test::bytes_of(output) == whole) << count << " shards";
    EXPECT_EQ(ResultReader(output).verify(), ResultReader(folder / "whole.h5").content_sha256());
    fs::remove(output);
  }
}

TEST(Merge, WithoutAllRunsSaysWhichAndWritesNothing) {
  test::TemporaryFolder const folder;
  IdentifyOptions options = options_for(folder / "merged.h5", 1);
  options.shard = {1, 3, "test"};
  run_shard(test::load_job(job), options, {});
  options.shard = {};
  JobStatus const status = read_status(segment_folder_of(options.output));
  EXPECT_EQ(status.unfinished_shares, (std::vector<std::size_t>{0, 2}));
  EXPECT_EQ(status.shares, 3u);
  try {
    merge(test::load_job(job), options, Completeness::whole, {});
    FAIL();
  } catch (Error const& error) {
    EXPECT_EQ(error.code(), ExitCode::stopped);
    EXPECT_EQ(error.problems().front().notes.front(),
              "de 0, 3 to 4; fade 0, 3 to 4; jde 0, 3 to 4; jade 0, 3 to 4; lshade 0, 3 to 4; cmaes 0, 3 to 4");
    EXPECT_EQ(error.problems().front().notes.back(),
              "they are of shards 0, 2 of 3: torquescope run JOB.toml --shard 0/3");
  }
  EXPECT_FALSE(fs::exists(options.output));
  merge(test::load_job(job), options, Completeness::partial, {});
  ResultReader const partial(options.output);
  EXPECT_EQ(partial.attribute<std::int64_t>("/runs/fade", "missing_runs"), 3);
  EXPECT_EQ(partial.texts("/runs/fade/stop_reason")[0], "missing");
  auto const median_run = partial.attribute<std::int64_t>("/runs/fade", "median_run");
  EXPECT_TRUE(median_run == 1 || median_run == 2) << median_run << " is not there";
  EXPECT_GT(partial.attribute<double>("/runs/fade", "mse_median"), 0.0);
}

}  // namespace resume_test
}  // namespace torquescope
