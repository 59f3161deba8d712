// From a recording to the motion of the fit, and the filter that torque and columns share.

#include "engine/data/motion.hpp"

#include <cmath>
#include <numbers>
#include <random>

#include "engine/base/random_stream.hpp"
#include "engine/data/spline_motion.hpp"
#include "unit/data/data_test_support.hpp"

namespace torquescope {
namespace motion_test {

using data_test::problem_of;

constexpr double pi = std::numbers::pi;

Section filter_section() {
  Section section;
  section.name = "filter";
  section.place = {"job.toml", 12, 1, 8, "[filter]"};
  section.settings.push_back({"cutoff_hz", 600.0, {"job.toml", 14, 1, 9, ""}, {"job.toml", 14, 13, 3, ""}});
  return section;
}

Recording sine_recording(double rate_hz, double seconds, double frequency_hz) {
  Recording recording;
  recording.rate_hz = rate_hz;
  auto const n = static_cast<Eigen::Index>(rate_hz * seconds);
  recording.time_s = Eigen::VectorXd::LinSpaced(n, 0.0, static_cast<double>(n - 1) / rate_hz);
  recording.position = (2 * pi * frequency_hz * recording.time_s.array()).sin();
  recording.torque = (2 * pi * frequency_hz * recording.time_s.array()).cos();
  return recording;
}

TEST(Differentiate, ParabolaHasItsDerivativesExactlyInside) {
  auto recording = sine_recording(100, 2, 1);
  recording.position = 3 - 2 * recording.time_s.array() + 1.5 * recording.time_s.array().square();
  auto const motion = differentiate(recording, {}, filter_section());
  for (Eigen::Index i = 2; i + 2 < motion.q.size(); ++i) {
    EXPECT_NEAR(motion.dq[i], -2 + 3 * motion.time_s[i], 1e-11);
    EXPECT_NEAR(motion.ddq[i], 3.0, 1e-9);
  }
  EXPECT_EQ(motion.torque, recording.torque);
}

TEST(SplineMotion, ComesToEveryPositionAndSlopeWhenItsAccelerationIsIntegrated) {
  Recording recording = sine_recording(100, 1, 1);
  RandomStream random({9, 0, RandomDomain::test}, 0, 0);
  recording.position = recording.position.unaryExpr([&](double q) { return q + random.uniform(-0.1, 0.1); });
  Eigen::VectorXd const position = recording.position;
  Motion const motion = spline_motion(std::move(recording));
  constexpr double h = 0.01;
  for (Eigen::Index k = 0; k + 1 < position.size(); ++k) {
    double const jerk = (motion.ddq[k + 1] - motion.ddq[k]) / h;
    ASSERT_NEAR(position[k] + h * motion.dq[k] + h * h * (motion.ddq[k] / 2 + h * jerk / 6), position[k + 1], 1e-12);
    ASSERT_NEAR(motion.dq[k] + h * (motion.ddq[k] + h * jerk / 2), motion.dq[k + 1], 1e-9);
  }
}

TEST(SplineMotion, KeepsAWaveThatCentralDifferencesLose) {
  constexpr double rate = 1000, frequency = 85, omega = 2 * pi * frequency;
  Motion const spline = spline_motion(sine_recording(rate, 2, frequency));
  Motion const differences = differentiate(sine_recording(rate, 2, frequency), {}, filter_section());
  double const peak = omega * omega;
  EXPECT_NEAR(spline.ddq.segment(500, 1000).maxCoeff(), peak, 0.03 * peak);
  EXPECT_LT(differences.ddq.segment(500, 1000).maxCoeff(), 0.92 * peak);
}

TEST(Differentiate, SineGivesTheAnalyticGainOfFilterAndDifferences) {
  constexpr double rate = 1000, frequency = 10, cutoff = 40;
  FilterOptions options;
  options.cutoff_hz = cutoff;
  auto const motion = differentiate(sine_recording(rate, 4, frequency), options, filter_section());
  double const gain = 1 / (1 + std::pow(std::tan(pi * frequency / rate) / std::tan(pi * cutoff / rate), 8));
  double const slope = std::sin(2 * pi * frequency / rate) * rate;  // of the central difference
  for (Eigen::Index i = 1500; i < 2500; ++i) {
    double const phase = 2 * pi * frequency * motion.time_s[i];
    ASSERT_NEAR(motion.q[i], gain * std::sin(phase), 1e-9);
    ASSERT_NEAR(motion.dq[i], gain * slope * std::cos(phase), 1e-7);
    ASSERT_NEAR(motion.ddq[i], -gain * slope * slope * std::sin(phase), 1e-5);
  }
}

TEST(Differentiate, GivenVelocityIsUsedInsteadOfThePosition) {
  auto recording = sine_recording(1000, 2, 2);
  recording.velocity = Eigen::VectorXd::LinSpaced(2000, 0, 1);
  EXPECT_EQ(differentiate(recording, {}, filter_section()).dq, recording.velocity);
  EXPECT_NEAR(differentiate(recording, {}, filter_section()).ddq[1000], 1000.0 / 1999, 1e-10);
  recording.acceleration = Eigen::VectorXd::Constant(2000, 0.25);
  EXPECT_EQ(differentiate(recording, {}, filter_section()).ddq, recording.acceleration);
}

TEST(Differentiate, CutoffAboveHalfTheRateIsRefusedAtItsPlace) {
  FilterOptions options;
  options.cutoff_hz = 600;
  auto const problem = problem_of([&] { differentiate(sine_recording(1000, 2, 2), options, filter_section()); });
  EXPECT_EQ(problem.code, ExitCode::bad_job);
  EXPECT_EQ(problem.what, "cutoff_hz = 600 is above half the sampling rate (500 Hz)");
  EXPECT_EQ(problem.help, "20 to 40 Hz suits a joint sampled at 1000 Hz");
  EXPECT_EQ(problem.key, "filter.cutoff_hz");
  EXPECT_EQ(problem.place.line, 14);
  EXPECT_EQ(problem.place.column, 13);
}

TEST(Differentiate, RecordingShorterThanTheFilterIsRefused) {
  FilterOptions options;
  options.cutoff_hz = 1;  // edges of three seconds
  auto const problem = problem_of([&] { differentiate(sine_recording(100, 4, 2), options, filter_section()); });
  EXPECT_EQ(problem.code, ExitCode::bad_data);
  EXPECT_EQ(problem.what, "a recording of 4 s (400 samples) is shorter than the filter, which needs 608 samples");
}

TEST(ParallelFilter, KeepsEveryManiethSampleBetweenTheEdges) {
  FilterOptions options;
  options.parallel_cutoff_hz = 50;  // three periods: 60 ms
  options.decimate_to_hz = 200;
  ParallelFilter const filter(options, 1000, 1003, filter_section());
  EXPECT_EQ(filter.kept_rate_hz(), 200);
  EXPECT_EQ(filter.kept_samples(), 177);  // 60, 65, ..., 940 of 0 .. 1002
  Eigen::VectorXd const index = Eigen::VectorXd::LinSpaced(1003, 0, 1002);
  auto const kept = filter.pick(index);
  ASSERT_EQ(kept.size(), 177);
  EXPECT_EQ(kept[0], 60);
  EXPECT_EQ(kept[1], 65);
  EXPECT_EQ(kept[176], 940);
  EXPECT_LT((filter.apply(index) - kept).cwiseAbs().maxCoeff(), 1e-3);  // a ramp passes
}

TEST(ParallelFilter, SaysHowNeighboursOfWhiteNoiseAreAlike) {
  FilterOptions options;
  options.parallel_cutoff_hz = 10;
  options.decimate_to_hz = 50;
  constexpr Eigen::Index n = 200000;
  ParallelFilter const filter(options, 500, n, filter_section());
  std::mt19937 random(3);
  std::normal_distribution<double> normal;
  Eigen::VectorXd const noise = Eigen::VectorXd::NullaryExpr(n, [&] { return normal(random); });
  Eigen::VectorXd const kept = filter.apply(noise);
  double const seen = kept.head(kept.size() - 1).dot(kept.tail(kept.size() - 1)) / kept.squaredNorm();
  EXPECT_NEAR(filter.neighbour_correlation(), seen, 4.0 / std::sqrt(static_cast<double>(kept.size())));
  EXPECT_GT(seen, 0.5);
  EXPECT_EQ(ParallelFilter({}, 500, n, filter_section()).neighbour_correlation(), 0.0);
}

TEST(ParallelFilter, DefaultsFollowTheKeptRate) {
  FilterOptions options;
  options.decimate_to_hz = 100;
  Eigen::VectorXd sine(4000);
  for (Eigen::Index i = 0; i < 4000; ++i) sine[i] = std::sin(2 * pi * 40 * static_cast<double>(i) / 1000);
  ParallelFilter const filter(options, 1000, 4000, filter_section());
  double const ratio = filter.apply(sine).norm() / filter.pick(sine).norm();
  EXPECT_NEAR(ratio, 0.5, 1e-3);  // 0.4 * 100 Hz is the half-gain point
  ParallelFilter const nothing({}, 1000, 4000, filter_section());
  EXPECT_EQ(nothing.kept_samples(), 3996);  // two one-sided differences at each end
  EXPECT_EQ(nothing.apply(sine), sine.segment(2, 3996));
  FilterOptions whole;
  whole.edge_s = 0;
  EXPECT_EQ(ParallelFilter(whole, 1000, 4000, filter_section()).kept_samples(), 4000);
}

// filtering commutes with the fit: any linear relation between columns and torque survives
TEST(ParallelFilter, KeepsLinearRelations) {
  RandomStream stream({25, 0, RandomDomain::test}, 0, 0);
  Eigen::MatrixXd columns(3000, 3);
  for (double& value : columns.reshaped()) value = stream.normal();
  Eigen::Vector3d const theta(0.5, -2, 30);
  FilterOptions options;
  options.parallel_cutoff_hz = 47;
  options.decimate_to_hz = 200;
  ParallelFilter const filter(options, 1000, 3000, filter_section());
  Eigen::VectorXd predicted = Eigen::VectorXd::Zero(filter.kept_samples());
  for (int c = 0; c < 3; ++c) predicted += theta[c] * filter.apply(columns.col(c));
  EXPECT_LT((filter.apply(columns * theta) - predicted).cwiseAbs().maxCoeff(), 1e-11);
}

TEST(ParallelFilter, RefusesRatesThatDoNotDivide) {
  FilterOptions options;
  options.decimate_to_hz = 300;
  auto const uneven = problem_of([&] { ParallelFilter(options, 1000, 5000, filter_section()); });
  EXPECT_EQ(uneven.code, ExitCode::bad_job);
  EXPECT_EQ(uneven.what, "decimate_to_hz = 300 does not divide the sampling rate (1000 Hz) into whole steps");
  EXPECT_EQ(uneven.help, "the nearest that does: decimate_to_hz = 333.333 (every 3rd sample)");
  options.decimate_to_hz = 333.333;  // what the help says to write
  EXPECT_NEAR(ParallelFilter(options, 1000, 5000, filter_section()).kept_rate_hz(), 1000.0 / 3, 1e-9);
  options.decimate_to_hz = 2000;
  EXPECT_EQ(problem_of([&] { ParallelFilter(options, 1000, 5000, filter_section()); }).help,
            "decimation only drops samples: leave it out to keep them all");
  options.decimate_to_hz = 200;
  options.parallel_cutoff_hz = 150;
  auto const folding = problem_of([&] { ParallelFilter(options, 1000, 5000, filter_section()); });
  EXPECT_EQ(folding.what,
            "parallel_cutoff_hz = 150 is not below half of decimate_to_hz (100 Hz): what lies between folds back");
  EXPECT_EQ(folding.help, "parallel_cutoff_hz = 80, or a higher decimate_to_hz");
  options.decimate_to_hz = 0;
  options.parallel_cutoff_hz = 500;
  EXPECT_EQ(problem_of([&] { ParallelFilter(options, 1000, 5000, filter_section()); }).what,
            "parallel_cutoff_hz = 500 is at half the sampling rate (500 Hz)");
}

}  // namespace motion_test
}  // namespace torquescope
