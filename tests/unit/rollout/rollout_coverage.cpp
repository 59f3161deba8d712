// Nineteen of twenty intervals hold the truth, though a joint's own encoder disturbs it and the torque is noisy.

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "unit/rollout/recorded_joints.hpp"

using namespace torquescope;
using namespace torquescope::test;

namespace rollout_coverage_test {

struct Count {
  int intervals = 0, misses = 0;
};

// intervals of one recording, whose motion is its own: an encoder's rounding repeats where the motion does
Count count(std::string const& form, int draw, Sensors sensors) {
  PlainJoint const joint = dry_joint();
  PlainController const controller = controller_of(form);
  PlainInputs inputs = moved(1500);
  for (double& goal : inputs.reference) goal *= 1.0 + 0.01 * draw;
  sensors.seed = static_cast<std::uint64_t>(draw);
  std::vector<RolloutTrack> const tracks{recorded(joint, controller, inputs, sensors)};
  LoopSetting const loop = free_loop(controller, tracks);
  RolloutModel const model(Regressor(joint_terms(), JointKind::revolute), 1.1 * truth_of(joint),
                           scales_of(tracks[0], joint), {}, loop);
  RolloutFit const fit = fit_rollouts(model, tracks, {true, true}, {}, 1, 1);
  EXPECT_FALSE(fit.failed) << form << draw;
  Count counted;
  for (Eigen::Index k = 0; k < fit.parameters.size(); ++k) {
    double const truth = k < 4 ? truth_of(joint)[k] : values_of(controller)[loop.free[static_cast<std::size_t>(k - 4)]];
    ++counted.intervals;
    counted.misses += fit.lower[k] <= truth && truth <= fit.upper[k] ? 0 : 1;
  }
  return counted;
}

// Measured once with 40 draws of every form, 1480 intervals: 0.950 at an encoder step of 1e-4 rad and 0.05 N m of
// noise, 0.956 at 2e-4 and 0.05, 0.934 at 5e-5 and 0.1. The worst number is the viscous friction in the cascade with
// an integral, 0.65 to 0.98, whose error is 1e-3 of itself there
TEST(RolloutCoverage, IsNominalOverAllLoops) {
  constexpr double least_coverage = 0.93, sigmas = 3.0;
  constexpr int draws = 15;
  Count all;
  for (std::string const form : {"p", "pi", "pd", "pid", "p_velocity", "p_pi"})
    for (int draw = 1; draw <= draws; ++draw) {
      Count const one = count(form, draw, {.encoder_step = 1e-4, .torque_noise = 0.05});
      all.intervals += one.intervals;
      all.misses += one.misses;
    }
  double const most = (1.0 - least_coverage) * all.intervals;
  EXPECT_LE(all.misses, most + sigmas * std::sqrt(most)) << "of " << all.intervals;
  // nor are they so wide that they say nothing: some do miss
  EXPECT_GE(all.misses, 0.01 * all.intervals);
}

}  // namespace rollout_coverage_test
