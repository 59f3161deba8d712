// What a job's simulations begin with.

#include "engine/experiment/rollout_parts.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "engine/experiment/experiment_parts.hpp"
#include "support/simulated_job.hpp"

namespace torquescope {
namespace rollout_parts_test {

// a time is sought about the period where the torque's band ends: without a filter that had been no number
TEST(RolloutParts, BeginTimesOfEffectsAtNumbersWithoutAFilterOfTheTorque) {
  std::string const joint = test::joint_model + test::simulated_joint;
  std::string const simulations =
      "[[model.effects]]\nname = \"friction_lag\"\n[loop]\ncontroller = \"pd\"\nkp = 30\nkd = 2\n"
      "[[estimator]]\nname = \"lm\"\n";
  for (std::string const filter : {"", "[filter]\ncutoff_hz = 30\n"}) {
    Experiment const experiment = test::load_job(joint + filter + simulations);
    ASSERT_TRUE(experiment.parts().rollout && experiment.parts().rollout->model);
    RolloutModel const& model = *experiment.parts().rollout->model;
    auto const names = model.names();
    ASSERT_NE(std::find(names.begin(), names.end(), "friction_lag_time"), names.end());
    for (auto const& one : model.parameters()) {
      EXPECT_TRUE(std::isfinite(one.start)) << one.name;
      EXPECT_TRUE(std::isfinite(one.scale) && one.scale > 0.0) << one.name;
    }
  }
}

}  // namespace rollout_parts_test
}  // namespace torquescope
