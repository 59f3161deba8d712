// The real axis as a whole job: the published parameters and errors (Janot, Gautier, Brunot 2019) come out.
#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "engine/experiment/experiment_parts.hpp"
#include "engine/simulate/controller_fit.hpp"
#include "engine/store/result_reader.hpp"
#include "engine/workflows/workflows.hpp"
#include "support/recordings_folder.hpp"
#include "support/temporary_folder.hpp"

namespace torquescope {
namespace {

namespace fs = std::filesystem;

// a job of jobs/, pointed at the recordings of this machine
std::string job_for(fs::path const& recordings, char const* name = "jobs/emps.toml") {
  std::string job = test::bytes_of(fs::path(TORQUESCOPE_SOURCE_DIR) / name);
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
  double const validation = result.attribute<double>("/runs/ols", "validation_relerr_median");
  EXPECT_GE(train, 0.040);
  EXPECT_LE(train, 0.041);
  EXPECT_GE(validation, 0.059);
  EXPECT_LE(validation, 0.060);
  // the population methods find the same optimum
  for (std::string const label : {"de", "fade"})
    EXPECT_NEAR(result.attribute<double>("/runs/" + label, "relerr_median"), train, 1e-5) << label;
}

// published: u = kv (kp (q_ref - q) - dq), in V
TEST(Emps, TheControllerFoundInItsTorqueIsThePublishedOne) {
  constexpr double newton_per_volt = 35.15065, kp = 160.18, kv = 243.45;
  fs::path const recordings = test::recordings_folder();
  SKIP_WITHOUT(recordings / "emps/emps_train.csv.gz");
  test::TemporaryFolder const folder;
  auto const job = Experiment::load(folder.write("emps.toml", job_for(recordings, "jobs/emps_diagnose.toml")),
                                    Experiment::Purpose::diagnose);
  Recording const& recording = job.parts().train.recordings.front();
  ASSERT_EQ(recording.reference.size(), recording.position.size());
  ControllerFit const found =
      fit_controller({recording.time_s, recording.reference, recording.position, recording.torque, nullptr});
  EXPECT_GT(found.r_squared, 0.99999);
  EXPECT_NEAR(found.controller.proportional_gain() / (kp * kv * newton_per_volt), 1.0, 1e-3);
  EXPECT_NEAR(found.controller.velocity_gain(recording.rate_hz) / (kv * newton_per_volt), 1.0, 0.01);
  EXPECT_EQ(found.controller.integral, 0.0);
  // the velocity loop has an encoder of its own: its rounding is not in the recorded position, so the remainder is
  // small but not white, and says so
  EXPECT_FALSE(found.is_white);
  EXPECT_LT(found.noise.std, 0.005 * newton_per_volt);
}

// Published, simulated in closed loop: 5.85 % of the force in training, 8.94 % on the pulses (Janot, Gautier, Brunot
// 2019)
TEST(Emps, IsSimulatedInItsLoopOnEverySample) {
  fs::path const recordings = test::recordings_folder();
  SKIP_WITHOUT(recordings / "emps/emps_train.csv.gz");
  test::TemporaryFolder const folder;
  std::string job = job_for(recordings, "jobs/emps_rollout.toml");
  // the published structure alone: the effects take twenty seconds
  auto const first = job.find("[[model.effects]]");
  job.erase(first, job.find("[loop]") - first);
  IdentifyOptions options;
  options.threads = {2, "test"};
  options.output = folder / "emps.h5";
  identify(Experiment::load(folder.write("emps.toml", job)), options, ProgressSink{});

  ResultReader const result(options.output);
  EXPECT_LE(result.attribute<double>("/runs/lm", "relerr_median"), 0.049);
  EXPECT_LE(result.attribute<double>("/runs/lm", "validation_relerr_median"), 0.054);
  auto const samples = result.whole_numbers("/replay/recording_2/torque/samples").values;
  EXPECT_EQ(samples.front(), 24841);
  // of its motion: published 0.008 % in position
  EXPECT_LE(result.numbers("/replay/recording_2/position/relerr").values.back(), 0.00008);
}

}  // namespace
}  // namespace torquescope
