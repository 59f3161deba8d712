// What a torque column is, beside the motion that it should have caused: joints under a limited drive, and zeros that
// move, are told apart from friction that does.

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "engine/fit/problem/command_limit.hpp"
#include "engine/fit/problem/computed_torque.hpp"
#include "engine/fit/problem/torque_zero.hpp"
#include "unit/problem/joint_data.hpp"

namespace torquescope {
namespace torque_column_test {

using Eigen::Index;

constexpr double rate_hz = 250.0, seconds = 24.0, pi = std::numbers::pi;
constexpr double inertia = 0.09, viscous = 0.35, coulomb = 0.6;
constexpr double unlimited = 1e9;

double smooth_sign(double dq) { return std::tanh(dq / 0.02); }

// A controller follows three sines; the column holds what it asks for, the joint gets that between the limits
Recording controlled(double lower, double upper, std::function<double(double time_s, double dq, double given)> extra) {
  auto const n = static_cast<Index>(seconds * rate_hz);
  Recording recording;
  recording.rate_hz = rate_hz;
  for (auto* channel : {&recording.time_s, &recording.position, &recording.reference, &recording.torque})
    channel->resize(n);
  Eigen::VectorXd const noise = test::white_noise(n, 1, 0.01);
  double q = 0.0, dq = 0.0;
  constexpr int substeps = 20;
  for (Index i = 0; i < n; ++i) {
    double const t = static_cast<double>(i) / rate_hz;
    double reference = 0.0, speed = 0.0;
    for (auto const& [size, hz] : {std::pair(0.5, 0.37), std::pair(0.3, 0.71), std::pair(0.1, 1.3)}) {
      reference += size * std::sin(2.0 * pi * hz * t);
      speed += size * 2.0 * pi * hz * std::cos(2.0 * pi * hz * t);
    }
    double const asked = inertia * (900.0 * (reference - q) + 40.0 * (speed - dq));
    recording.time_s[i] = t;
    recording.reference[i] = reference;
    recording.position[i] = q;
    recording.torque[i] = asked + noise[i];
    double const given = std::clamp(asked, lower, upper);
    for (int k = 0; k < substeps; ++k) {
      double const friction = viscous * dq + coulomb * smooth_sign(dq) + extra(t, dq, given);
      dq += (given - friction) / inertia / (rate_hz * substeps);
      q += dq / (rate_hz * substeps);
    }
  }
  return recording;
}

double nothing_more(double, double, double) { return 0.0; }

std::optional<TorqueBesideMotion> beside(Recording const& recording) {
  FilterOptions filter;
  filter.cutoff_hz = 20.0, filter.parallel_cutoff_hz = 10.0, filter.decimate_to_hz = 50.0;
  Regressor const regressor({"inertia", "viscous", "coulomb", "offset"}, JointKind::revolute);
  return TorqueBesideMotion::of(recording, filter, regressor, {});
}

BesideOfJoints beside_joints(Recording recording, Eigen::VectorXd const& position) {
  recording.position = position;
  return {beside(recording)};
}

std::vector<ComputedTorque> computed(Recording const& recording) {
  return computed_torques({recording}, beside_joints(recording, recording.position),
                          [&](auto const& positions) { return beside_joints(recording, positions.front()); });
}

// what a model that knows no offset, and half of the friction, gives for the commanded motion
Eigen::VectorXd model_of_reference(Recording const& recording) {
  Eigen::VectorXd const speed = central_derivative(recording.reference, rate_hz);
  return 1.3 * inertia * central_derivative(speed, rate_hz) + 0.5 * viscous * speed +
         0.5 * coulomb * speed.unaryExpr(&smooth_sign);
}

std::optional<CommandLimit> limit_of(Recording const& recording) {
  return command_limit(beside(recording).value(), recording.torque);
}

std::optional<TorqueZero> zero_of(Recording const& recording) {
  return torque_zero(beside(recording).value(), recording.time_s, recording.torque);
}

TEST(CommandLimit, IsFoundOnEitherSideAndOnBoth) {
  for (auto const& [lower, upper] : {std::pair(-2.1, 2.1), std::pair(-2.2, 2.0), std::pair(-unlimited, 2.1)}) {
    auto const recording = controlled(lower, upper, nothing_more);
    auto const limit = limit_of(recording);
    ASSERT_TRUE(limit) << lower << " " << upper;
    EXPECT_NEAR(limit->upper.value_or(unlimited), upper, 0.05 * upper);
    ASSERT_EQ(limit->lower.has_value(), lower > -unlimited);
    if (limit->lower.has_value()) {
      EXPECT_NEAR(*limit->lower, lower, 0.05 * -lower);
    }
    EXPECT_LT(limit->error_after, 0.5 * limit->error_before);
    EXPECT_LE(limited(recording.torque, *limit).maxCoeff(), *limit->upper);
  }
}

TEST(CommandLimit, IsNoneOfTorquesThatWereGiven) {
  EXPECT_FALSE(limit_of(controlled(-unlimited, unlimited, nothing_more)));
  // friction that grows with the load bends the torque, too
  EXPECT_FALSE(limit_of(controlled(-unlimited, unlimited, [](double, double dq, double given) {
    return 0.15 * std::fabs(given) * smooth_sign(dq);
  })));
  // the motor gives less and less of what is asked for: no kink at one level
  EXPECT_FALSE(limit_of(controlled(-unlimited, unlimited,
                                   [](double, double, double given) { return given - 3.0 * std::tanh(given / 3.0); })));
}

// one long way forth, one back: the torque is below zero on the way back alone, where it holds what no function of the
// motion explains
Recording forth_and_back(double share_back, double unexplained) {
  auto recording = controlled(-unlimited, unlimited, nothing_more);
  auto const n = recording.position.size();
  auto const forth = static_cast<Index>((1.0 - share_back) * static_cast<double>(n));
  double q = 0.0;
  for (Index i = 0; i < n; ++i) {
    bool const back = i >= forth;
    double const along = back ? static_cast<double>(i - forth) / static_cast<double>(n - forth)
                              : static_cast<double>(i) / static_cast<double>(forth);
    double const dq = (back ? -0.3 : 0.2) * std::sin(pi * along);
    q += dq / rate_hz;
    recording.position[i] = recording.reference[i] = q;
    recording.torque[i] =
        2.0 * smooth_sign(dq) + viscous * dq + (back ? unexplained * std::sin(9.0 * recording.time_s[i]) : 0.0);
  }
  recording.torque += test::white_noise(n, 2, 0.01);
  return recording;
}

// the torque of one direction is no command beyond a limit, however badly it is explained
TEST(CommandLimit, IsNoneOfADirectionOfMotion) {
  for (double const share : {0.2, 0.3, 0.34, 0.5})
    for (double const unexplained : {0.1, 0.4, 0.8})
      EXPECT_FALSE(limit_of(forth_and_back(share, unexplained))) << share << " " << unexplained;
}

TEST(TorqueZero, StepsAtItsSample) {
  for (double const size : {0.4, -0.15}) {
    auto recording = controlled(-unlimited, unlimited, nothing_more);
    Index const at = 3321;
    recording.torque.tail(recording.torque.size() - at).array() += size;
    auto const zero = zero_of(recording);
    ASSERT_TRUE(zero) << size;
    EXPECT_EQ(zero->change, ZeroChange::step);
    EXPECT_NEAR(static_cast<double>(zero->sample), static_cast<double>(at), 5.0);  // the cut-off mixes 12
    EXPECT_NEAR(zero->size, size, 0.05 * std::fabs(size));
    EXPECT_NEAR(zero_error(*zero, recording.time_s).tail(1)[0], zero->size, 1e-12);
  }
}

TEST(TorqueZero, Drifts) {
  auto recording = controlled(-unlimited, unlimited, nothing_more);
  recording.torque += 0.3 / seconds * recording.time_s;
  auto const zero = zero_of(recording);
  ASSERT_TRUE(zero);
  EXPECT_EQ(zero->change, ZeroChange::drift);
  EXPECT_NEAR(zero->size, 0.3, 0.02);
  EXPECT_GT(zero->explained, 0.5);
}

TEST(TorqueZero, IsNoneOfFrictionThatChanges) {
  EXPECT_FALSE(zero_of(controlled(-unlimited, unlimited, nothing_more)));
  EXPECT_FALSE(zero_of(controlled(-unlimited, unlimited,
                                  [](double t, double dq, double) { return t > 11.0 ? 0.2 * smooth_sign(dq) : 0.0; })));
  EXPECT_FALSE(zero_of(controlled(-unlimited, unlimited, [](double t, double dq, double) {
    return (0.3 * smooth_sign(dq) + 0.1 * dq) * std::exp(-t / 8.0);
  })));
}

TEST(ComputedTorque, IsAModelsForTheCommandedMotion) {
  auto recording = controlled(-unlimited, unlimited, nothing_more);
  recording.torque = model_of_reference(recording);
  auto const found = computed(recording);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_GT(found.front().error_of_motion, 3.0 * found.front().error_of_reference);
}

TEST(ComputedTorque, IsNoneOfATorqueThatMovesTheJoint) {
  EXPECT_TRUE(computed(controlled(-unlimited, unlimited, nothing_more)).empty());
  EXPECT_TRUE(computed(controlled(-unlimited, unlimited, [](double t, double dq, double) {
                return 0.3 * std::sin(t) + 0.4 * smooth_sign(dq) * std::exp(-std::fabs(dq) / 0.1);
              })).empty());
}

// the joint does what it is told, so that the commanded motion is the true one
TEST(ComputedTorque, IsNoneWhereOnlyTheMeasuredPositionIsWrong) {
  auto recording = controlled(-unlimited, unlimited, nothing_more);
  recording.reference = recording.position;
  constexpr Index late = 5;
  Eigen::VectorXd const motion = recording.position;
  recording.position.tail(motion.size() - late) = motion.head(motion.size() - late);
  EXPECT_TRUE(computed(recording).empty());
  constexpr double count = 2.0 * pi / 2048.0;
  recording.position = (motion / count).array().round() * count;
  recording.rows.encoder_step = count;
  EXPECT_TRUE(computed(recording).empty());
}

}  // namespace torque_column_test
}  // namespace torquescope
