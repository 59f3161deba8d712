// Real machines, where their recordings are at hand (tests/support/recordings_folder.hpp).

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <cmath>

#include "engine/data/excitation.hpp"
#include "engine/data/health/make_recording.hpp"
#include "engine/data/motion.hpp"
#include "engine/data/recording_reader.hpp"
#include "support/decompositions.hpp"
#include "support/recordings_folder.hpp"

namespace torquescope {
namespace real_recordings_test {

using test::recordings_folder;

Section section() {
  Section recording;
  recording.name = "recording";
  return recording;
}

Recording read(std::filesystem::path const& path, std::map<std::string, std::string> columns,
               double torque_per_unit = 1.0) {
  RecordingOptions options;
  options.columns = std::move(columns);
  options.torque_per_unit = {torque_per_unit};
  return make_recording(read_table(path, section()), options, section());
}

FilterOptions emps_filter() {
  FilterOptions options;
  options.cutoff_hz = 100;
  options.parallel_cutoff_hz = 47;
  options.decimate_to_hz = 200;
  return options;
}

struct Regression {
  Eigen::MatrixXd columns;  // ddq, dq, sign(dq), 1
  Eigen::VectorXd torque;
};

Regression emps(std::string const& name) {
  auto const recording =
      read(recordings_folder() / "emps" / name, {{"time", "t_s"}, {"position", "q_m"}, {"torque", "u_V"}}, 35.15065);
  auto const motion = differentiate(recording, emps_filter(), section());
  ParallelFilter const filter(emps_filter(), motion.rate_hz, motion.q.size(), section());
  Regression regression{{filter.kept_samples(), 4}, filter.apply(motion.torque)};
  regression.columns << filter.apply(motion.ddq), filter.apply(motion.dq),
      filter.apply(motion.dq.unaryExpr([](double v) { return static_cast<double>((v > 0) - (v < 0)); })),
      filter.apply(Eigen::VectorXd::Ones(motion.q.size()));
  return regression;
}

double relative_error(Regression const& regression, Eigen::Vector4d const& theta) {
  return (regression.torque - regression.columns * theta).norm() / regression.torque.norm();
}

// published: M 95.1089, Fv 203.5034, Fc 20.3935, offset -3.1648; 4.0834 % on train, 5.9824 % on pulses
// (Janot, Gautier, Brunot 2019; their decimation filter is a Chebyshev, ours a Butterworth)
TEST(EmpsBenchmark, LeastSquaresFindsThePublishedParameters) {
  SKIP_WITHOUT(recordings_folder() / "emps" / "emps_train.csv.gz");
  auto const train = emps("emps_train.csv.gz");
  Eigen::Vector4d const theta = test::least_squares(train.columns, train.torque);
  EXPECT_NEAR(theta[0], 95.1, 0.3);
  EXPECT_NEAR(theta[1], 203.5, 0.5);
  EXPECT_NEAR(theta[2], 20.4, 0.1);
  EXPECT_NEAR(theta[3], -3.16, 0.03);
  double const on_train = relative_error(train, theta),
               on_pulses = relative_error(emps("emps_valid_pulses.csv.gz"), theta);
  EXPECT_GT(on_train, 0.040);
  EXPECT_LT(on_train, 0.041);
  EXPECT_GT(on_pulses, 0.059);
  EXPECT_LT(on_pulses, 0.060);
}

TEST(EmpsBenchmark, StampsPrintedWithRoundingNeedNoResampling) {
  auto const path = recordings_folder() / "emps" / "emps_train.csv.gz";
  SKIP_WITHOUT(path);
  auto const recording = read(path, {{"time", "t_s"}, {"position", "q_m"}, {"torque", "F_N"}});
  EXPECT_EQ(recording.rate_hz, 1000);
  EXPECT_EQ(recording.position.size(), 24841);
  EXPECT_EQ(recording.rows.resampled, 0);
  auto const excitation =
      measure_excitation(recording, differentiate(recording, emps_filter(), section()), emps_filter());
  EXPECT_EQ(excitation.quadrants, 4);
  EXPECT_TRUE(excitation_warnings(excitation, "m").empty());
}

TEST(PandaRecording, JitteredClockIsResampledAt1000Hz) {
  auto const path = recordings_folder() / "panda" / "panda_exciting_traj1.csv.gz";
  SKIP_WITHOUT(path);
  auto const recording = read(path, {{"time", "t_s"}, {"position", "q1_rad"}, {"torque", "tau1_Nm"}});
  EXPECT_EQ(recording.rate_hz, 1000);
  EXPECT_NEAR(recording.time_s[recording.time_s.size() - 1], 21.0, 0.2);
  EXPECT_GT(recording.rows.missing, 0);
  ASSERT_FALSE(recording.warnings.empty());
  EXPECT_EQ(recording.warnings[0].topic, "jitter");
}

TEST(Ur10eRecording, EveryJointReadsAt100Hz) {
  auto const path = recordings_folder() / "ur10e" / "ident_20_02_10_30sec_12harm.csv.gz";
  SKIP_WITHOUT(path);
  for (std::string const joint : {"1", "2", "3", "4", "5", "6"}) {
    auto const recording = read(path,
                                {{"time", "t_s"},
                                 {"position", "q" + joint + "_rad"},
                                 {"torque", "i" + joint + "_A"},
                                 {"velocity", "qd" + joint + "_radps"}},
                                10.0);
    EXPECT_EQ(recording.rate_hz, 100);
    EXPECT_GT(recording.rows.resampled, 1000);
  }
}

TEST(KinovaRecording, ConstantSpeedIsWarnedOf) {
  auto const path = recordings_folder() / "kinova_gen3" / "kinova_j7_v0.50.csv";
  SKIP_WITHOUT(path);
  RecordingOptions options;
  options.columns = {{"position", "q_rad"}, {"torque", "tau_sensor_Nm"}};
  options.rate_hz = 1000;
  auto const recording = make_recording(read_table(path, section()), options, section());
  FilterOptions filter;
  filter.cutoff_hz = 20;
  auto const excitation = measure_excitation(recording, differentiate(recording, filter, section()), filter);
  auto const warnings = excitation_warnings(excitation, "rad");
  ASSERT_FALSE(warnings.empty());
  EXPECT_NE(warnings[0].text.find("only one direction"), std::string::npos);
}

TEST(BamRecordings, AllReadDespiteTheirClocks) {
  auto const folder = recordings_folder() / "bam";
  SKIP_WITHOUT(folder);
  for (auto const& entry : std::filesystem::directory_iterator(folder)) {
    bool const has_load = entry.path().filename().string().starts_with("xl330");
    auto const recording =
        read(entry.path(), {{"time", "t_s"}, {"position", "q_rad"}, {"torque", has_load ? "load_raw" : "vin_V"}});
    EXPECT_GT(recording.rate_hz, 40) << entry.path();
    EXPECT_GT(recording.position.size(), 200) << entry.path();
    EXPECT_NEAR(recording.rows.encoder_step, 2 * 3.14159265 / 4096, 1e-5) << entry.path();  // 12 bit
  }
}

}  // namespace real_recordings_test
}  // namespace torquescope
