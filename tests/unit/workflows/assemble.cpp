#include <gtest/gtest.h>

#include "engine/base/error.hpp"
#include "engine/experiment/experiment_parts.hpp"
#include "engine/experiment/recordings_of_job.hpp"
#include "support/simulated_job.hpp"

namespace torquescope {
namespace assemble_test {

using test::load_job;
using test::simulated_joint;
using test::TemporaryFolder;

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

// columns of a file are those of the same numbers in memory, and the file is never looked for
TEST(LoadExperiment, TakesARecordingFromMemoryAsFromItsFile) {
  TemporaryFolder const folder;
  auto const simulated = folder.write("simulate.toml", "[model]\nterms = [\"inertia\"]\n" + simulated_joint);
  simulate_recording(simulated, folder / "motion.csv");
  std::string const job = test::joint_model +
                          "[[estimator]]\nname = \"ols\"\n[recording]\ntrain = \"motion.csv\"\n"
                          "columns = {time = \"t_s\", position = \"q_rad\", torque = \"tau_Nm\"}\n";
  auto const job_file = folder.write("job.toml", job);
  auto const from_file = Experiment::load(job_file);

  RawTable const read = read_table(folder / "motion.csv", {"recording", {}, {}});
  NamedColumns columns;
  for (std::size_t c = 0; c < read.names.size(); ++c) columns.emplace_back(read.names[c], read.columns[c]);
  std::filesystem::remove(folder / "motion.csv");
  EXPECT_THROW(Experiment::load(job_file), Error);
  RecordedTables const tables{{"motion.csv", table_in_memory("motion.csv", columns)}};
  auto const from_memory = Experiment::load(read_job(job_file), Experiment::Purpose::identify, tables);

  auto const &file_rows = from_file.parts().train.regression, &memory_rows = from_memory.parts().train.regression;
  EXPECT_EQ(file_rows.phi, memory_rows.phi);
  EXPECT_EQ(file_rows.tau, memory_rows.tau);
  EXPECT_EQ(from_memory.parts().train.recordings.front().name, "motion.csv");
}

TEST(LoadExperiment, KnowsRecordingsInMemoryByTheirNumbers) {
  std::vector<double> const rising{1.0, 2.0, 3.0}, falling{3.0, 2.0, 1.0};
  auto const digest = [](std::string const& name, std::vector<double> const& values) {
    return table_in_memory(name, {{"a", values}, {"b", values}}).sha256;
  };
  EXPECT_EQ(digest("x", rising), digest("y", rising));
  EXPECT_NE(digest("x", rising), digest("x", falling));
}

// one clock, one warning
TEST(BringToRate, SaysOnceForAllJointsOfAFileThatTheyWereResampled) {
  Recording joint;
  joint.rate_hz = 100.0;
  joint.time_s = Eigen::VectorXd::LinSpaced(200, 0.0, 1.99);
  joint.position = joint.time_s.array().sin();
  joint.torque = joint.time_s.array().cos();
  std::vector<Recording> joints(3, joint), alone(3, joint), same(3, joint);
  bring_joints_to_rate(joints, 101.0);
  bring_to_rate(alone, 101.0);
  bring_joints_to_rate(same, 100.0);
  for (std::size_t j = 0; j < joints.size(); ++j) {
    EXPECT_EQ(joints[j].rate_hz, 101.0);
    EXPECT_EQ(joints[j].position, alone[j].position);
    EXPECT_EQ(joints[j].warnings.size(), j == 0 ? 1U : 0U);
    EXPECT_EQ(alone[j].warnings.size(), 1U);
    EXPECT_TRUE(same[j].warnings.empty());
  }
}

}  // namespace assemble_test
}  // namespace torquescope
