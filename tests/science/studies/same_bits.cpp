// The same job gives the same content whatever the threads and the instruction set (engine/README.md, Determinism).
#include <gtest/gtest.h>

#include <filesystem>
#include <set>
#include <utility>

#include "engine/workflows/workflows.hpp"
#include "kernels/dispatch.hpp"
#include "support/simulated_job.hpp"

namespace torquescope {
namespace {

namespace fs = std::filesystem;

std::string digest_of(Experiment experiment, int threads) {
  test::TemporaryFolder const folder;
  IdentifyOptions options;
  options.threads = {threads, "test"};
  options.output = folder / "R.h5";
  return identify(std::move(experiment), options, ProgressSink{}).content_sha256;
}

std::string digest_of(std::string const& job, int threads) {
  return digest_of(Experiment::load(fs::path(TORQUESCOPE_SOURCE_DIR) / "jobs" / job), threads);
}

TEST(SameBits, ForOneTwoAndThreeThreads) {
  for (std::string const job : {"smoke.toml", "crs_a465_joint.toml"}) {
    std::set<std::string> digests;
    for (int threads : {1, 2, 3}) digests.insert(digest_of(job, threads));
    EXPECT_EQ(digests.size(), 1u) << job;
    EXPECT_EQ(digests.begin()->size(), 64u);
  }
}

TEST(SameBits, ForMoreThreadsThanRuns) {
  // smoke has 4 runs: nine threads make teams of two that split each population
  EXPECT_EQ(digest_of("smoke.toml", 1), digest_of("smoke.toml", 9));
}

// 4.8 MB and more: runs go side by side, in groups of 2 and 3, 1 and 2, or alone, depending on the threads. Some stop
// early
TEST(SameBits, ForRunsThatShareASweep) {
  std::string const job = R"(
[experiment]
name = "long"
runs = 5
[simulate]
mode = "inverse_dynamics"
rate_hz = 1000
duration_s = 200
[simulate.plant]
inertia = 0.5
viscous = 0.2
coulomb = 0.1
[model.bounds]
every = [-1.0, 1.0]
[[estimator]]
name = "de"
generations = 12
fitness_range = 0.5
fitness = "direct"
[[estimator]]
name = "fade"
population = 17
generations = 4
precision = "float32"
)" + test::joint_model + "[simulate.noise]\ntorque_std = 0.05\n";
  std::set<std::string> digests;
  for (int threads : {1, 2, 3, 5}) digests.insert(digest_of(test::load_job(job), threads));
  EXPECT_EQ(digests.size(), 1u);
}

TEST(SameBits, ForEveryInstructionSetWithFma) {
  std::set<std::string> digests;
  int tried = 0;
  for (auto const target : kernels::supported_instruction_sets()) {
    ASSERT_TRUE(kernels::force_instruction_set(target));
    if (!kernels::instruction_set_has_fma()) continue;
    digests.insert(digest_of("smoke.toml", 2));
    ++tried;
  }
  kernels::release_instruction_set();
  if (tried < 2) GTEST_SKIP() << "this machine has " << tried << " instruction set with FMA: nothing to compare";
  EXPECT_EQ(digests.size(), 1u);
}

}  // namespace
}  // namespace torquescope
