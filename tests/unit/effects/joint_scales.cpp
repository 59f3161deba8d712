// Bounds follow the data: change the units of everything, and they change as units do.

#include "engine/effects/joint_scales.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <sstream>

#include "unit/effects/smooth_motion.hpp"

namespace torquescope {
namespace joint_scales_test {

// how many of the new units one old unit is
struct Units {
  double metre = 1.0, second = 1.0, newton = 1.0;
};

double factor_of(std::string const& symbol, Units const& units) {
  auto const power = symbol.find_last_of("0123456789") == std::string::npos || symbol == "1" ? 1 : symbol.back() - '0';
  auto const base = symbol.substr(0, symbol.find_first_of("0123456789"));
  double one = std::nan("");
  if (symbol == "1") one = 1.0;
  if (base == "m") one = units.metre;
  if (base == "s") one = units.second;
  if (base == "N") one = units.newton;
  if (base == "Hz") one = 1.0 / units.second;
  if (base == "kg") one = units.newton * units.second * units.second / units.metre;
  return std::pow(one, power);
}

// "N s2/m2"
double factor_of_unit(std::string const& unit, Units const& units) {
  auto const slash = unit.find('/');
  double factor = slash == std::string::npos ? 1.0 : 1.0 / factor_of(unit.substr(slash + 1), units);
  std::istringstream above(unit.substr(0, slash));
  for (std::string symbol; above >> symbol;) factor *= factor_of(symbol, units);
  return factor;
}

JointScales slide_in(Units const& u) {
  JointScales scales;
  scales.joint = JointKind::prismatic;
  scales.start_s = 3.0 * u.second;
  scales.duration_s = 60.0 * u.second;
  scales.rate_hz = 1000.0 / u.second;
  scales.cutoff_hz = 40.0 / u.second;
  scales.peak_speed = 0.7 * u.metre / u.second;
  scales.position_range = 0.4 * u.metre;
  scales.position_centre = 0.1 * u.metre;
  scales.encoder_step = 1e-6 * u.metre;
  scales.torque_rms = 20.0 * u.newton;
  scales.torque_peak = 60.0 * u.newton;
  scales.torque_highest = 60.0 * u.newton;
  scales.torque_lowest = 45.0 * u.newton;
  scales.coulomb_positive = 8.0 * u.newton;
  scales.coulomb_negative = 9.0 * u.newton;
  scales.inertia = 90.0 * u.newton * u.second * u.second / u.metre;
  scales.viscous = 30.0 * u.newton * u.second / u.metre;
  return scales;
}

TEST(Bounds, ScaleAsTheUnitsOfTheirParameter) {
  Units const odd{1e3, 60.0, 0.1};
  auto const plain = slide_in({}), scaled = slide_in(odd);
  auto const expect_alike = [](double value, double expected, std::string const& name) {
    if (std::isfinite(expected)) {
      EXPECT_NEAR(value, expected, 1e-12 * std::abs(expected)) << name;
    } else {
      EXPECT_EQ(value, expected) << name;
    }
  };
  for (auto const* effect : effect_choices()) {
    auto bounds = effect->linear_bounds(plain), other = effect->linear_bounds(scaled);
    for (auto const& range : effect->shape_bounds(plain)) bounds.push_back(range);
    for (auto const& range : effect->shape_bounds(scaled)) other.push_back(range);
    for (std::size_t k = 0; k < bounds.size(); ++k) {
      auto const& parameter = effect->parameters()[k];
      bool const has_bound = std::isfinite(bounds[k].lower * bounds[k].upper) && bounds[k].upper != 0.0;
      if (parameter.unit_prismatic.empty() || !has_bound) continue;
      double const factor = factor_of_unit(parameter.unit_prismatic, odd);
      expect_alike(other[k].lower, bounds[k].lower * factor, parameter.name);
      expect_alike(other[k].upper, bounds[k].upper * factor, parameter.name);
    }
  }
}

TEST(Bounds, AreIntervalsAndPositiveWhereTheSearchTakesLogarithms) {
  for (auto const* effect : effect_choices()) {
    for (auto const& range : effect->shape_bounds(slide_in({}))) {
      EXPECT_LT(range.lower, range.upper) << effect->name();
      EXPECT_TRUE(std::isfinite(range.lower) && std::isfinite(range.upper)) << effect->name();
      EXPECT_TRUE(range.spacing != Spacing::logarithmic || range.lower > 0.0) << effect->name();
    }
    for (auto const& range : effect->linear_bounds(slide_in({}))) EXPECT_LT(range.lower, range.upper) << effect->name();
  }
}

// a friction coefficient and the share of the inertia it feels: nothing but weight, or a spring, tells one from the
// other
TEST(Bounds, LeaveNoInertiaShareWhereInertiaIsAllTheLoad) {
  auto scales = slide_in({});
  for (auto const& [name, place] : {std::pair{"load_dependent_friction", 0}, std::pair{"directional_efficiency", 1}}) {
    auto const at = static_cast<std::size_t>(place);
    scales.bears_only_inertia = true;
    auto const alone = find_effect(name)->shape_bounds(scales)[at];
    EXPECT_EQ(alone.lower, 1.0) << name;
    EXPECT_EQ(alone.upper, 1.0) << name;
    scales.bears_only_inertia = false;
    EXPECT_EQ(find_effect(name)->shape_bounds(scales)[at].lower, 0.0) << name;
  }
}

TEST(Bounds, OfZeroAreSignsFromPhysics) {
  EXPECT_EQ(find_effect("stribeck")->parameters()[0].sign(), Sign::non_negative);
  EXPECT_EQ(find_effect("speed_drag")->parameters()[0].sign(), Sign::non_negative);
  EXPECT_EQ(find_effect("speed_drag")->parameters()[1].sign(), Sign::non_negative);
  EXPECT_EQ(find_effect("cogging")->parameters()[0].sign(), Sign::any);
  EXPECT_EQ(find_effect("viscous")->parameters()[0].sign(), Sign::any);
}

TEST(Bounds, AreReadableWithoutTheData) {
  EXPECT_EQ(bound_text({0.2, RelativeTo::peak_speed}), "0.2 x peak speed");
  EXPECT_EQ(bound_text({0.0, RelativeTo::coulomb}), "0");
  EXPECT_EQ(bound_text({std::numeric_limits<double>::infinity()}), "no bound");
  EXPECT_EQ(bound_text({0.5}), "0.5");
}

TEST(FrictionSign, KeepsTheAsymmetryOfTheBaseline) {
  JointScales scales;
  EXPECT_EQ(scales.friction_sign()(2.0), 1.0);
  EXPECT_EQ(scales.friction_sign()(-2.0), -1.0);
  scales.coulomb_positive = 0.3;
  scales.coulomb_negative = 0.5;
  EXPECT_DOUBLE_EQ(scales.coulomb() * scales.friction_sign()(2.0), 0.3);
  EXPECT_DOUBLE_EQ(scales.coulomb() * scales.friction_sign()(-2.0), -0.5);
  EXPECT_EQ(scales.friction_sign()(0.0), 0.0);
}

TEST(FittedBaseline, TellsLevelsLoadAndWholeTorqueApart) {
  test::KnownJoint const joint;
  auto motion = test::motion_of(test::smooth_state, 3000, 500.0, 7.0);
  auto const baseline = joint.baseline(motion);
  auto const& scales = baseline.scales;
  EXPECT_DOUBLE_EQ(scales.coulomb_positive, 0.3);
  EXPECT_DOUBLE_EQ(scales.coulomb_negative, 0.5);
  EXPECT_EQ(scales.inertia, 0.05);
  EXPECT_EQ(scales.viscous, 0.2);
  EXPECT_EQ(scales.gravity_sin, 1.2);
  EXPECT_EQ(scales.gravity_cos, -0.4);
  EXPECT_EQ(scales.start_s, 7.0);
  EXPECT_DOUBLE_EQ(scales.duration_s, 2999.0 / 500.0);
  for (Eigen::Index i = 0; i < 3000; i += 11) {
    double const load = 0.05 * motion.ddq[i] + 1.2 * std::sin(motion.q[i]) - 0.4 * std::cos(motion.q[i]);
    EXPECT_NEAR(baseline.load_torque[i], load, 1e-14);
    EXPECT_NEAR(baseline.model_torque[i], motion.torque[i], 1e-13);
  }
}

TEST(FittedBaseline, TakesACoulombLevelOfTheWrongSignForAnOffset) {
  test::KnownJoint joint;
  joint.parameters[2] = -0.1;
  auto motion = test::motion_of(test::smooth_state, 300, 500.0);
  EXPECT_EQ(joint.baseline(motion).scales.coulomb_positive, 0.0);
}

}  // namespace joint_scales_test
}  // namespace torquescope
