// Instruments from a simulation: in a closed loop with noisy positions least squares is biased, iv is not.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "engine/base/error.hpp"
#include "engine/experiment/experiment_parts.hpp"
#include "support/temporary_folder.hpp"

namespace torquescope {
namespace arm_instruments_test {

// two links in a vertical plane
std::string const robot = R"(
[robot]
name = "planar arm"
convention = "modified_dh"
gravity = [0.0, 0.0, -9.81]
[[joint]]
name = "shoulder"
alpha_rad = 1.5707963267948966
lower = -1.5
upper = 1.5
drive_inertia = 0.2
mass_kg = 4.0
centre_m = [0.2, 0.01, 0.0]
inertia_kgm2 = [0.01, 0.0, 0.0, 0.06, 0.0, 0.06]
[[joint]]
name = "elbow"
a_m = 0.4
lower = -1.5
upper = 1.5
drive_inertia = 0.1
mass_kg = 2.0
centre_m = [0.15, 0.02, 0.0]
inertia_kgm2 = [0.004, 0.0, 0.0, 0.02, 0.0, 0.02]
)";

// the positions' noise is felt by the controllers as well
std::string job(int seed, double position_std, std::string const& estimators) {
  return "[experiment]\nseed = " + std::to_string(seed) +
         "\n[model]\nrobot = \"robot.toml\"\nfriction = [\"viscous\", \"coulomb\", \"offset\"]\n"
         "[filter]\ncutoff_hz = 12\nparallel_cutoff_hz = 12\ndecimate_to_hz = 50\n"
         "[simulate]\nrate_hz = 200\nduration_s = 16\nstep_s = 1e-3\n"
         "[simulate.plant]\nviscous = [1.5, 0.8]\ncoulomb = [2.0, 1.0]\noffset = [0.3, -0.2]\n"
         "[simulate.reference]\namplitude = 1.2\nband_hz = [0.2, 1.0]\nbase_hz = 0.2\n"
         "[simulate.controller]\nkind = \"pd\"\nrate_hz = 200\nbandwidth_hz = 4\nvelocity_cutoff_hz = 60\n"
         "[simulate.encoder]\nstep = 0.0\n"
         "[simulate.noise]\ntorque_std = 0.2\nposition_std = " +
         std::to_string(position_std) + "\n" + estimators;
}

std::string const both = "[[estimator]]\nname = \"wls\"\n[[estimator]]\nname = \"iv\"\n";

Experiment load(std::string const& text) {
  test::TemporaryFolder const folder;
  folder.write("robot.toml", robot);
  return Experiment::load(folder.write("job.toml", text), Experiment::Purpose::identify);
}

TEST(Instruments, TakeTheBiasOfNoisyPositionsAway) {
  constexpr int draws = 6;
  Eigen::VectorXd plain, instrumental, errors;
  for (int seed = 1; seed <= draws; ++seed) {
    auto const experiment = load(job(seed, 2e-3, both));
    auto const& parts = experiment.parts();
    auto const wls = parts.estimators[0].fit(parts.train.regression),
               iv = parts.estimators[1].fit(parts.train.regression);
    EXPECT_TRUE(iv.converged) << iv.remark;
    if (seed == 1) plain = instrumental = errors = Eigen::VectorXd::Zero(parts.truth.size());
    plain += (wls.parameters - parts.truth) / draws;
    instrumental += (iv.parameters - parts.truth) / draws;
    errors += iv.standard_error / draws;
  }
  Eigen::ArrayXd const of_mean = errors.array() / std::sqrt(static_cast<double>(draws));
  // in standard errors of the mean over draws, over all parameters: 1 where there is no bias
  double const bias = std::sqrt((plain.array() / of_mean).square().mean());
  double const left = std::sqrt((instrumental.array() / of_mean).square().mean());
  EXPECT_GT(bias, 2.0) << "the noise of the positions must show";
  EXPECT_LT(left, 0.5 * bias) << bias << " to " << left;
}

TEST(Instruments, WithoutNoiseOfThePositionsFindWhatLeastSquaresFinds) {
  auto const experiment = load(job(3, 0.0, both));
  auto const& parts = experiment.parts();
  auto const wls = parts.estimators[0].fit(parts.train.regression),
             iv = parts.estimators[1].fit(parts.train.regression);
  EXPECT_TRUE(iv.converged);
  EXPECT_LT(((iv.parameters - wls.parameters).array().abs() / iv.standard_error.array()).maxCoeff(), 2.0);
}

std::string refusal(std::string const& text) {
  try {
    load(text);
  } catch (Error const& error) {
    return error.problems().front().what;
  }
  return "";
}

TEST(Instruments, NeedTheCommandedMotionOfAnArm) {
  std::string exact = job(1, 0.0, both);
  exact.replace(exact.find("[simulate]"), 10, "[simulate]\nmode = \"inverse_dynamics\"");
  for (auto const* section : {"[simulate.controller]", "[simulate.encoder]"}) {
    auto const from = exact.find(section);
    exact.erase(from, exact.find("[simulate.", from + 1) - from);
  }
  exact.erase(exact.find("position_std"), exact.find("[[estimator]]") - exact.find("position_std"));
  EXPECT_THAT(refusal(exact), testing::HasSubstr("no commanded positions"));
  EXPECT_THAT(refusal("[model]\nterms = [\"inertia\"]\n[simulate]\n[simulate.plant]\ninertia = 1.0\n" + both),
              testing::HasSubstr("iv is for arms"));
}

}  // namespace arm_instruments_test
}  // namespace torquescope
