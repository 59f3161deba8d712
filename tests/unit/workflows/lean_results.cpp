// What `run` keeps in memory and in its result: [output] samples = false and populations = false change no number, and
// no fit needs the channels.

#include <gtest/gtest.h>

#include "engine/experiment/experiment_parts.hpp"
#include "engine/store/result_reader.hpp"
#include "support/simulated_job.hpp"

namespace torquescope {
namespace lean_results_test {

std::string const job = test::joint_model + "[filter]\nedge_s = 0\n[model.bounds]\nevery = [-1, 1]\n" +
                        test::simulated_joint +
                        "[simulate.noise]\ntorque_std = 0.01\n[experiment]\nname = \"lean\"\nruns = 2\n"
                        "[[estimator]]\nname = \"ols\"\n[[estimator]]\nname = \"de\"\ngenerations = 20\n";

void identify_into(std::filesystem::path const& result, std::string const& text) {
  IdentifyOptions options;
  options.threads = {1, "test"};
  options.output = result;
  identify(test::load_job(text), options, ProgressSink{});
}

TEST(Samples, LeftOutChangeNoNumber) {
  test::TemporaryFolder const folder;
  identify_into(folder / "all.h5", job);
  identify_into(folder / "lean.h5", job + "[output]\nsamples = false\n");
  ResultReader const all(folder / "all.h5"), lean(folder / "lean.h5");
  for (std::string const path :
       {"/runs/ols/parameters", "/runs/ols/standard_error", "/runs/ols/mse", "/runs/de/population",
        "/runs/de/gap_history", "/runs/de/validation_relerr", "/data/regressor_health/correlation"})
    EXPECT_EQ(lean.numbers(path).values, all.numbers(path).values) << path;
  EXPECT_EQ(lean.attribute<double>("/data/regressor_health", "condition_number"),
            all.attribute<double>("/data/regressor_health", "condition_number"));
}

TEST(Samples, LeftOutAreCounted) {
  test::TemporaryFolder const folder;
  identify_into(folder / "lean.h5", job + "[output]\nsamples = false\n");
  ResultReader const lean(folder / "lean.h5");
  for (std::string const group : {"/data/train", "/data/validate"}) {
    EXPECT_EQ(lean.attribute<std::int64_t>(group, "samples"), 1000) << group;
    for (std::string const name : {"time", "recording", "position", "velocity", "acceleration", "torque", "regressor"})
      EXPECT_FALSE(lean.exists(group + "/" + name)) << group << name;
    EXPECT_EQ(lean.attribute<double>(group, "duration_s"), 5.0);
  }
}

TEST(Populations, LeftOutChangeNoNumber) {
  test::TemporaryFolder const folder;
  identify_into(folder / "all.h5", job);
  identify_into(folder / "lean.h5", job + "[output]\npopulations = false\n");
  ResultReader const all(folder / "all.h5"), lean(folder / "lean.h5");
  for (std::string const path : {"/runs/de/parameters", "/runs/de/gap_history", "/runs/de/best", "/runs/de/gap"})
    EXPECT_EQ(lean.numbers(path).values, all.numbers(path).values) << path;
  for (std::string const path : {"/runs/de/population", "/runs/de/fitness"}) {
    EXPECT_TRUE(all.exists(path)) << path;
    EXPECT_FALSE(lean.exists(path)) << path;
  }
}

TEST(Experiment, KeepsChannelsForADiagnosisOnly) {
  auto const channels = [](Experiment const& experiment) {
    auto const& recording = experiment.parts().train.recordings.front();
    return recording.time_s.size() + recording.position.size() + recording.torque.size() + recording.reference.size() +
           recording.velocity.size() + recording.acceleration.size();
  };
  EXPECT_EQ(channels(test::load_job(job)), 0);
  EXPECT_EQ(channels(test::load_job(job, Experiment::Purpose::diagnose)), 6 * 1000);
  EXPECT_NE(test::load_job(job).data_line().find("1000 samples, 5 s at 200 Hz"), std::string::npos);
}

TEST(Experiment, NeedsNoMotionOnceItIsWritten) {
  auto experiment = test::load_job(job);
  EXPECT_EQ(experiment.parts().train.regression.q.size(), 1000);
  experiment.forget_motion();
  auto const& rows = experiment.parts().train.regression;
  EXPECT_EQ(rows.time_s.size() + rows.q.size() + rows.dq.size() + rows.ddq.size(), 0);
  EXPECT_EQ(rows.rows(), 1000);
  EXPECT_TRUE(rows.moves_both_ways());
}

}  // namespace lean_results_test
}  // namespace torquescope
