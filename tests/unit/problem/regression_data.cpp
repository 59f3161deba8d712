#include "engine/fit/problem/regression_data.hpp"

#include <gmock/gmock.h>

#include <numbers>

#include "unit/problem/joint_data.hpp"

namespace torquescope {
namespace regression_data_test {

using testing::HasSubstr;

// the seed's joint as a data logger sees it: position and torque only
Recording logged(std::string name, double seconds, double rate_hz, Eigen::Vector4d const& parameters) {
  auto const n = static_cast<Eigen::Index>(std::lround(seconds * rate_hz));
  Recording recording;
  recording.name = std::move(name);
  recording.rate_hz = rate_hz;
  recording.time_s.resize(n);
  recording.position.resize(n);
  recording.torque.resize(n);
  Regressor const regressor(test::seed_terms, JointKind::revolute);
  double const w = 2.0 * std::numbers::pi * 0.5, u = 2.0 * std::numbers::pi * 1.3;
  for (Eigen::Index i = 0; i < n; ++i) {
    double const t = static_cast<double>(i) / rate_hz;
    JointState const state{t, std::sin(w * t) + 0.2 * std::sin(u * t), w * std::cos(w * t) + 0.2 * u * std::cos(u * t),
                           -w * w * std::sin(w * t) - 0.2 * u * u * std::sin(u * t)};
    recording.time_s[i] = t;
    recording.position[i] = state.q;
    recording.torque[i] = regressor.torque(state, {parameters.data(), 4});
  }
  return recording;
}

FilterOptions filter() {
  FilterOptions options;
  options.cutoff_hz = 40.0;
  options.parallel_cutoff_hz = 20.0;
  options.decimate_to_hz = 100.0;
  return options;
}

Regressor seed_regressor() { return Regressor(test::seed_terms, JointKind::revolute); }

TEST(RegressionData, GivesTheTruthBackFromPositionAndTorque) {
  auto const data = make_regression_data({logged("a", 20.0, 1000.0, test::seed_ols)}, filter(), seed_regressor(), {});
  auto const fit = test::fit("ols", data);
  // the filtered velocity changes sign up to a sample early or late: friction within 0.5 %
  for (Eigen::Index r = 0; r < 4; ++r)
    EXPECT_NEAR(fit.parameters[r], test::seed_ols[r], 0.005 * test::seed_ols.cwiseAbs().maxCoeff()) << r;
  EXPECT_LT(fit.metrics.relerr, 0.01);
}

TEST(RegressionData, StacksRecordingsAndKnowsWhoseRowsAreWhose) {
  auto const first = logged("first", 10.0, 1000.0, test::seed_ols),
             second = logged("second", 6.0, 500.0, test::seed_ols);
  auto const both = make_regression_data({first, second}, filter(), seed_regressor(), {});
  auto const alone = make_regression_data({second}, filter(), seed_regressor(), {});
  ASSERT_EQ(both.recordings(), 2u);
  EXPECT_EQ(both.first_row[2], both.rows());
  EXPECT_EQ(both.rows() - both.first_row[1], alone.rows());
  EXPECT_EQ(both.phi.bottomRows(alone.rows()), alone.phi);  // no filter runs across the border
  EXPECT_EQ(both.tau.tail(alone.rows()), alone.tau);
  EXPECT_EQ(both.recording_of(0), 0u);
  EXPECT_EQ(both.recording_of(both.first_row[1]), 1u);
  EXPECT_THAT(both.recording_names, testing::ElementsAre("first", "second"));
  EXPECT_THAT(both.rate_hz, testing::ElementsAre(1000.0, 500.0));
  EXPECT_EQ(both.kept_rate_hz, 100.0);
  EXPECT_EQ(both.phi.rows(), both.rows());
  EXPECT_EQ(both.q.size(), both.rows());
  EXPECT_EQ(both.recording_of(both.rows() - 1), 1u);
}

// without a filter: every sample is a row
FilterOptions no_filter() {
  FilterOptions options;
  options.edge_s = 0.0;
  return options;
}

TEST(RegressionData, OfAMotionThatIsUsedUpHasTheSameRows) {
  auto const recording = logged("a", 20.0, 1000.0, test::seed_ols);
  for (auto const& options : {no_filter(), filter()}) {
    auto const kept = make_regression_data({recording}, options, seed_regressor(), {});
    RegressionData lean;
    append_rows(lean, "a", differentiate(recording, options, {}), options, seed_regressor(), {}, RowMotion::used_up);
    EXPECT_EQ(lean.phi, kept.phi);
    EXPECT_EQ(lean.tau, kept.tau);
    EXPECT_EQ(lean.rows(), kept.rows());
    EXPECT_EQ(lean.dq.size(), 0);
    EXPECT_TRUE(lean.moves_both_ways());
  }
}

TEST(RegressionData, UsesUpNothingThatALaterTermNeeds) {
  // a deadband, gravity last (it needs the position) and terms that need nothing
  Regressor const regressor({"offset", "inertia", "coulomb", "gravity"}, JointKind::revolute, 0.2);
  auto const recording = logged("a", 20.0, 1000.0, test::seed_ols);
  auto const motion = differentiate(recording, no_filter(), {});
  RegressionData lean;
  append_rows(lean, "a", Motion(motion), no_filter(), regressor, {}, RowMotion::used_up);
  EXPECT_EQ(lean.phi, regressor.columns(motion));
}

std::vector<double> numbers(std::span<double const> values) { return {values.begin(), values.end()}; }
std::vector<double> numbers(Eigen::VectorXd const& values) { return {values.begin(), values.end()}; }

std::vector<double> times(RegressionData const& data) {
  std::vector<double> seconds(static_cast<std::size_t>(data.rows()));
  data.time(0, seconds);
  return seconds;
}

TEST(RegressionData, HoldsNothingOfTheMotionTwiceAndTellsAllOfIt) {
  auto recording = logged("a", 20.0, 1000.0, test::seed_ols);
  auto shifted = recording;
  shifted.time_s.array() += 1.0;
  // inertia and viscous friction are acceleration and velocity; with the columns of neither, with a deadband, with
  // uneven time and with a filter there is something that nothing else tells
  Regressor const seed = seed_regressor(), none({"coulomb", "gravity"}, JointKind::revolute, 0.2),
                  drag_last({"coulomb", "viscous"}, JointKind::revolute, 0.2);
  struct Case {
    Recording const& recording;
    FilterOptions options;
    Regressor const& regressor;
    Eigen::Index held;  // of time, velocity and acceleration
  };
  for (auto const& [of, options, regressor, held] : {Case{recording, no_filter(), seed, 0},
                                                     {recording, no_filter(), none, 2},
                                                     {recording, no_filter(), drag_last, 1},
                                                     {shifted, no_filter(), seed, 1},
                                                     {recording, filter(), seed, 3}}) {
    auto const kept = make_regression_data({of}, options, regressor, {});
    RegressionData once;
    append_rows(once, "a", differentiate(of, options, {}), options, regressor, {}, RowMotion::once);
    EXPECT_EQ(once.phi, kept.phi);
    EXPECT_EQ(once.tau, kept.tau);
    EXPECT_EQ(once.q, kept.q);
    EXPECT_EQ(times(once), numbers(kept.time_s));
    EXPECT_EQ(numbers(once.velocity()), numbers(kept.dq));
    EXPECT_EQ(numbers(once.acceleration()), numbers(kept.ddq));
    EXPECT_EQ(once.time_s.size() + once.dq.size() + once.ddq.size(), held * once.rows());
    EXPECT_TRUE(once.moves_both_ways());
    once.forget_motion();
    EXPECT_TRUE(once.velocity().empty());
    EXPECT_TRUE(once.moves_both_ways());
  }
}

TEST(RegressionData, KnowsDirectionsOfAMotionItHasForgotten) {
  auto both = test::seed_data(5.0);
  auto forwards = both;
  forwards.dq = forwards.dq.cwiseAbs();
  for (auto* data : {&both, &forwards}) data->forget_motion();
  EXPECT_TRUE(both.moves_both_ways());
  EXPECT_FALSE(forwards.moves_both_ways());
  EXPECT_EQ(both.q.size() + both.dq.size() + both.ddq.size() + both.time_s.size(), 0);
}

TEST(RegressionData, FiltersTorqueAndColumnsAlike) {
  // if torque is a combination of the columns before the filter, it is the same combination after it
  Regressor const regressor({"inertia", "viscous"}, JointKind::revolute);
  auto recording = logged("a", 10.0, 1000.0, test::seed_ols);
  auto const motion = differentiate(recording, filter(), {});
  recording.torque = regressor.columns(motion) * Eigen::Vector2d(0.3, 0.7);
  auto const data = make_regression_data({recording}, filter(), regressor, {});
  EXPECT_LT((data.tau - data.phi * Eigen::Vector2d(0.3, 0.7)).norm(), 1e-12 * data.tau.norm());
}

TEST(RegressionData, RefusesRecordingsThatKeepDifferentRates) {
  auto options = filter();
  options.decimate_to_hz = 0.0;
  try {
    make_regression_data({logged("fast", 10.0, 1000.0, test::seed_ols), logged("slow", 10.0, 500.0, test::seed_ols)},
                         options, seed_regressor(), {});
    FAIL();
  } catch (Error const& error) {
    EXPECT_EQ(error.code(), ExitCode::bad_data);
    EXPECT_THAT(error.problems()[0].what, HasSubstr("slow keeps 500 samples a second, fast keeps 1000"));
    EXPECT_THAT(error.problems()[0].help, HasSubstr("decimate_to_hz = 500"));
  }
}

}  // namespace regression_data_test
}  // namespace torquescope
