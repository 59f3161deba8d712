// What a recording shows of itself, and what it cannot tell.

#include "engine/data/excitation.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "engine/base/random_stream.hpp"
#include "engine/data/signal_facts.hpp"
#include "unit/data/data_test_support.hpp"

namespace torquescope {
namespace excitation_test {

using testing::HasSubstr;
constexpr double pi = std::numbers::pi;

std::span<double const> numbers(Eigen::VectorXd const& values) {
  return {values.data(), static_cast<std::size_t>(values.size())};
}

Eigen::VectorXd sampled(Eigen::Index n, double (*function)(double)) {
  Eigen::VectorXd values(n);
  for (Eigen::Index i = 0; i < n; ++i) values[i] = function(static_cast<double>(i) / 1000);
  return values;
}

Eigen::VectorXd rounded(Eigen::VectorXd const& values, double step) { return (values.array() / step).round() * step; }

struct Joint {
  Recording recording;
  Excitation excitation;
};

Joint joint_with(Eigen::VectorXd const& position, Eigen::VectorXd const& torque) {
  Joint joint;
  joint.recording.rate_hz = 1000;
  joint.recording.time_s =
      Eigen::VectorXd::LinSpaced(position.size(), 0, static_cast<double>(position.size() - 1) / 1000);
  joint.recording.position = position;
  joint.recording.torque = torque;
  FilterOptions options;
  options.cutoff_hz = 50;
  joint.excitation = measure_excitation(joint.recording, differentiate(joint.recording, options, {}), options);
  return joint;
}

TEST(QuantisationStep, FindsTheEncodersStepWithinADigitOfPrinting) {
  auto const motion = sampled(20000, [](double t) { return std::sin(2 * t) + 0.3 * std::sin(7 * t); });
  for (double step : {2 * pi / 4096, 2 * pi / (1 << 17), 1e-3}) {
    EXPECT_NEAR(quantisation_step(numbers(rounded(motion, step))) / step, 1.0, 1e-6);
    EXPECT_NEAR(quantisation_step(numbers(rounded(rounded(motion, step), step / 100))) / step, 1.0, 0.02);
  }
}

TEST(QuantisationStep, IsZeroForSmoothAndNoisySignals) {
  auto motion = sampled(20000, [](double t) { return std::sin(2 * t) + 0.3 * std::sin(7 * t); });
  EXPECT_EQ(quantisation_step(numbers(motion)), 0.0);
  RandomStream stream({26, 0, RandomDomain::test}, 0, 0);
  for (double& value : motion) value += 1e-4 * stream.normal();
  EXPECT_EQ(quantisation_step(numbers(motion)), 0.0);
  EXPECT_EQ(quantisation_step(numbers(Eigen::VectorXd::Constant(100, 2.0))), 0.0);
}

TEST(LimitShare, CountsFlatTopsAndNotTurningPoints) {
  auto const torque = sampled(20000, [](double t) { return std::sin(3 * t); });
  Eigen::VectorXd const clipped = torque.cwiseMin(0.9).cwiseMax(-0.95);
  double const expected = static_cast<double>((clipped.array() == 0.9 || clipped.array() == -0.95).count()) / 20000;
  EXPECT_NEAR(limit_share(numbers(clipped)), expected, 1e-12);
  EXPECT_EQ(limit_share(numbers(torque)), 0.0);
  EXPECT_EQ(limit_share(numbers(rounded(torque, 0.01))), 0.0);  // coarse, but free
  EXPECT_GT(limit_share(numbers(rounded(clipped, 0.01))), 0.9 * expected);
}

TEST(HeldRows, AreThoseOfAnEvenGridAndNotOfACoarseSignal) {
  auto const torque = sampled(20000, [](double t) { return std::sin(3 * t) + 0.2 * std::sin(11 * t); });
  auto const held = [&](Eigen::VectorXd values, Eigen::Index rows) {
    for (Eigen::Index i = 0; i < values.size(); ++i)
      values[i] = values[std::max<Eigen::Index>(0, (i + 3) / rows * rows - 3)];
    return held_rows(numbers(values));
  };
  EXPECT_EQ(held(torque, 1), 1);
  EXPECT_EQ(held(torque, 2), 2);
  EXPECT_EQ(held(torque, 20), 20);
  EXPECT_EQ(held(rounded(torque, 0.003), 20), 20);
  EXPECT_EQ(held(rounded(torque, 0.05), 1), 1);  // repeats itself, on any row
  EXPECT_EQ(held_rows(numbers(Eigen::VectorXd::Constant(500, 1.0))), 1);
}

TEST(WhiteNoise, MeasuresTheStandardDeviationUnderASmoothSignal) {
  RandomStream stream({27, 0, RandomDomain::test}, 0, 0);
  auto torque = sampled(50000, [](double t) { return 5 * std::sin(3 * t); });
  for (double& value : torque) value += 0.02 * stream.normal();
  EXPECT_NEAR(white_noise(torque), 0.02, 0.0006);  // 1.2/sqrt(2 n) of a median, neighbours correlated: three of them
}

TEST(Excitation, CountsReversalsQuadrantsAndDirections) {
  auto const position = sampled(10000, [](double t) { return std::sin(2 * pi * t); });
  auto const torque =
      sampled(10000, [](double t) { return std::sin(2 * pi * t); });  // a quarter turn from the velocity
  auto const facts = joint_with(position, torque).excitation;
  EXPECT_EQ(facts.reversals, 20);
  EXPECT_EQ(facts.quadrants, 4);
  EXPECT_NEAR(facts.forward_share, 0.5, 0.01);
  for (double share : facts.quadrant_share) EXPECT_NEAR(share, 0.25, 0.01);
  EXPECT_NEAR(facts.speed_most, 2 * pi, 0.02);
  EXPECT_NEAR(facts.position_most - facts.position_least, 2.0, 0.01);
  EXPECT_NEAR(facts.duration_s, 10.0, 1e-12);
  // of the speeds of a sine those from 1/1.2 of the largest on: 1 - 2 asin(1/1.2) / pi, over the moving time
  EXPECT_NEAR(facts.one_speed_share, 1.0 - 2.0 * std::asin(1.0 / 1.2) / pi, 0.03);
  EXPECT_TRUE(excitation_warnings(facts, "rad").empty());
}

TEST(Excitation, KnowsAMotionThatRampsToOneSpeed) {
  // strokes there and back: 2 s at one speed, ramps of 0.25 s at either end
  Eigen::VectorXd position(20000);
  double q = 0.0;
  for (Eigen::Index k = 0; k < position.size(); ++k) {
    double const within = std::fmod(static_cast<double>(k) * 1e-3, 5.0), stroke = std::fmod(within, 2.5);
    position[k] = q += 1e-3 * (within < 2.5 ? 1.0 : -1.0) * std::min({1.0, stroke / 0.25, (2.5 - stroke) / 0.25});
  }
  auto const facts = joint_with(position, position).excitation;
  // and the part of the ramps above 1/1.2 of it
  EXPECT_NEAR(facts.one_speed_share, (2.0 + 0.5 * (1.0 - 1.0 / 1.2)) / (2.5 - 0.5 * 0.01), 0.01);
}

TEST(Excitation, OneDirectionAtOneSpeedIsWarnedOf) {
  auto const torque = sampled(5000, [](double t) { return 1 + 0.1 * std::sin(40 * t); });
  auto const one_way = joint_with(sampled(5000, [](double t) { return 0.4 * t; }), torque).excitation;
  auto const warnings = excitation_warnings(one_way, "rad");
  ASSERT_EQ(warnings.size(), 2u);
  EXPECT_EQ(warnings[0].topic, "excitation");
  EXPECT_THAT(warnings[0].text, HasSubstr("only one direction of motion (100 % of the moving time)"));
  EXPECT_THAT(warnings[1].text, HasSubstr("only one speed (0.4 rad/s)"));
}

TEST(Excitation, MotionOfAFewEncoderStepsIsWarnedOf) {
  auto const motion =
      rounded(sampled(10000, [](double t) { return 0.01 * std::sin(2 * t) + 0.004 * std::sin(9 * t); }), 2 * pi / 4096);
  auto const joint = joint_with(motion, sampled(10000, [](double t) { return std::sin(9 * t); }));
  EXPECT_NEAR(joint.excitation.encoder_step, 2 * pi / 4096, 1e-12);
  auto const warnings = excitation_warnings(joint.excitation, "rad");
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_THAT(warnings[0].text, HasSubstr("encoder steps"));
}

TEST(Excitation, FactsOfTheRowsComeBeforeThoseOfTheResampledSignals) {
  auto joint = joint_with(sampled(4000, [](double t) { return std::sin(2 * t); }),
                          sampled(4000, [](double t) { return std::sin(9 * t); }));
  EXPECT_EQ(joint.excitation.encoder_step, 0.0);
  joint.recording.rows.encoder_step = 1e-3;
  joint.recording.rows.torque_limit_share = 0.02;
  joint.recording.rows.jitter = 0.1;
  auto const facts = measure_excitation(joint.recording, differentiate(joint.recording, {}, {}), {});
  EXPECT_EQ(facts.encoder_step, 1e-3);
  EXPECT_EQ(facts.torque_limit_share, 0.02);
  EXPECT_EQ(facts.jitter, 0.1);
}

}  // namespace excitation_test
}  // namespace torquescope
