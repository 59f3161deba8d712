#include <gtest/gtest.h>

#include "engine/base/error.hpp"
#include "engine/run/experiment_parts.hpp"
#include "support/simulated_job.hpp"

namespace torquescope {
namespace assemble_test {

using test::load_job;
using test::simulated_joint;

TEST(LoadExperiment, KnowsTheTruthOfSimulatedData) {
  Experiment const experiment = load_job(test::joint_model + "[[estimator]]\nname = \"ols\"\n" + simulated_joint);
  auto const& parts = experiment.parts();
  ASSERT_EQ(parts.truth.size(), 4);
  EXPECT_EQ(parts.truth[0], 0.5);
  EXPECT_TRUE(parts.train.simulated);
  EXPECT_EQ(parts.train.regression.phi.cols(), 4);
  ASSERT_TRUE(parts.validate.has_value());
}

TEST(LoadExperiment, TellsEveryProblemOfAJobAtOnce) {
  std::string const job =
      "[experimnt]\nseed = 1\n[filter]\ncutof_hz = 3\n[model]\nterms = [\"inertai\"]\n[[estimator]]\nname = \"fad\"\n" +
      simulated_joint;
  try {
    load_job(job);
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
  EXPECT_THROW(load_job(fit), Error);
  EXPECT_THROW(load_job(fit + "[recording]\ntrain = \"a.csv\"\n" + simulated_joint), Error);
}

}  // namespace assemble_test
}  // namespace torquescope
