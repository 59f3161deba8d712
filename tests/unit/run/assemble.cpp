#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "engine/base/error.hpp"
#include "engine/run/experiment_parts.hpp"

namespace torquescope {
namespace {

std::filesystem::path write_job(std::string const& text) {
  auto const path = std::filesystem::temp_directory_path() / ("assemble_" + std::to_string(getpid()) + ".toml");
  std::ofstream(path) << text;
  return path;
}

std::string const simulated_joint = R"(
[simulate]
mode = "inverse_dynamics"
rate_hz = 200
duration_s = 5
[simulate.plant]
inertia = 0.5
viscous = 0.2
coulomb = 0.1
)";

TEST(LoadExperiment, KnowsTheTruthOfSimulatedData) {
  auto const job = write_job(
      "[model]\nterms = [\"inertia\", \"viscous\", \"coulomb\", \"offset\"]\n[[estimator]]\nname = \"ols\"\n" +
      simulated_joint);
  Experiment const experiment = Experiment::load(job);
  auto const& parts = experiment.parts();
  ASSERT_EQ(parts.truth.size(), 4);
  EXPECT_EQ(parts.truth[0], 0.5);
  EXPECT_TRUE(parts.train.simulated);
  EXPECT_EQ(parts.train.regression.phi.cols(), 4);
  ASSERT_TRUE(parts.validate.has_value());
}

TEST(LoadExperiment, TellsEveryProblemOfAJobAtOnce) {
  auto const job = write_job(
      "[experimnt]\nseed = 1\n[filter]\ncutof_hz = 3\n[model]\nterms = [\"inertai\"]\n[[estimator]]\nname = \"fad\"\n" +
      simulated_joint);
  try {
    Experiment::load(job);
    FAIL();
  } catch (Error const& error) {
    ASSERT_EQ(error.problems().size(), 4u);
    EXPECT_EQ(error.code(), ExitCode::bad_job);
    EXPECT_EQ(error.problems()[0].caret_note, "did you mean [experiment]?");
    EXPECT_EQ(error.problems()[1].place.line, 4);
  }
}

TEST(LoadExperiment, RefusesTwoSourcesOfDataAndNone) {
  std::string const fit = "[model]\nterms = [\"inertia\"]\n[[estimator]]\nname = \"ols\"\n";
  EXPECT_THROW(Experiment::load(write_job(fit)), Error);
  EXPECT_THROW(Experiment::load(write_job(fit + "[recording]\ntrain = \"a.csv\"\n" + simulated_joint)), Error);
}

}  // namespace
}  // namespace torquescope
