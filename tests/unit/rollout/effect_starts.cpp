// Shapes begin where they explain most: the order of a wave among hundreds, one wave after the other.

#include "engine/simulate/rollout/effect_starts.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>

using namespace torquescope;

namespace effect_starts_test {

constexpr double rate_hz = 200.0;
constexpr Eigen::Index samples = 2000;
constexpr std::array parameters{0.1, 0.3, 0.2};

Motion motion() {
  Motion made;
  made.rate_hz = rate_hz;
  made.time_s = Eigen::VectorXd::LinSpaced(samples, 0.0, static_cast<double>(samples - 1) / rate_hz);
  made.q = 2.0 * (0.9 * made.time_s).array().sin();
  made.dq = 1.8 * (0.9 * made.time_s).array().cos();
  made.ddq = -1.62 * (0.9 * made.time_s).array().sin();
  made.torque = Regressor({"inertia", "viscous", "coulomb"}, JointKind::revolute).columns(made) *
                Eigen::Map<Eigen::VectorXd const>(parameters.data(), parameters.size());
  return made;
}

FittedBaseline baseline(Motion const& of) {
  constexpr double cutoff_hz = 40.0;
  return fitted_baseline(Regressor({"inertia", "viscous", "coulomb"}, JointKind::revolute), parameters, of, cutoff_hz,
                         0.0);
}

Eigen::VectorXd wave(Motion const& of, double order, double cosine, double sine) {
  return (cosine * (order * of.q).array().cos() + sine * (order * of.q).array().sin()).matrix();
}

// a wave is told from those half a wave more over the travel
double half_a_wave(Motion const& of) { return std::numbers::pi / (of.q.maxCoeff() - of.q.minCoeff()); }

TEST(EffectStarts, FindTheOrdersOfTwoWavesTheStrongerOneFirst) {
  Motion const at = motion();
  Effect const* const cogging = find_effect("cogging");
  auto const found = with_first_shapes({{cogging, {}}, {cogging, {}}}, at, baseline(at),
                                       wave(at, 14.0, 0.3, -0.2) + wave(at, 23.0, 0.1, 0.1));
  EXPECT_NEAR(found[0].values.at("cogging_order"), 14.0, half_a_wave(at));
  EXPECT_NEAR(found[1].values.at("cogging_order"), 23.0, half_a_wave(at));
}

TEST(EffectStarts, LeaveWhatTheJobGives) {
  Motion const at = motion();
  auto const found = with_first_shapes({{find_effect("cogging"), {{"cogging_order", 9.0}, {"cogging_cos", 0.5}}}}, at,
                                       baseline(at), wave(at, 14.0, 0.3, -0.2));
  EXPECT_EQ(found[0].values.at("cogging_order"), 9.0);
  EXPECT_EQ(found[0].values.at("cogging_cos"), 0.5);
}

TEST(EffectStarts, KeepSignsThatPhysicsDemands) {
  Motion const at = motion();
  // friction that falls towards rest: Stribeck friction of the wrong sign
  Eigen::VectorXd const left =
      at.dq.unaryExpr([](double v) { return v > 0.0 ? -std::exp(-v / 0.2) : std::exp(v / 0.2); });
  auto const found = with_first_shapes({{find_effect("stribeck"), {}}}, at, baseline(at), left);
  EXPECT_GE(found[0].values.at("stribeck"), 0.0);
}

}  // namespace effect_starts_test
