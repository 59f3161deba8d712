// The grid on which a shape is tried: bounds belong to it, the unit scale can be undone, and no wave falls between two
// points.

#include "engine/infer/decision/shape_grid.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <ostream>
#include <string>

#include "engine/base/random_stream.hpp"
#include "support/decompositions.hpp"

namespace torquescope {
namespace shape_grid_test {

constexpr double rounding = 1e-12;  // relative

JointScales scales_of(double duration_s = 12.0, double range = 2.4) {
  JointScales scales;
  scales.start_s = 3.0;
  scales.duration_s = duration_s;
  scales.rate_hz = 200.0;
  scales.cutoff_hz = 25.0;
  scales.peak_speed = 3.0;
  scales.position_range = range;
  scales.position_centre = 0.3;
  scales.encoder_step = 1e-4;
  scales.torque_rms = 2.0;
  scales.torque_peak = 5.0;
  scales.coulomb_positive = 1.1;
  scales.coulomb_negative = 1.3;
  scales.inertia = 0.05;
  scales.viscous = 0.2;
  return scales;
}

// of four or more, one that is linear, or absent at its lower bound
bool is_left_to_refinement(Effect const& effect, ShapeGrid const& grid, std::size_t k) {
  auto const& parameter = effect.parameters()[effect.n_linear() + k];
  return grid.axes.size() >= 4 && (grid.ranges[k].spacing == Spacing::linear || parameter.none_at_lower);
}

TEST(ShapeGrid, IncludesBothBoundsOfEveryShape) {
  JointScales const scales = scales_of();
  int with_shape = 0;
  for (Effect const* effect : effect_choices()) {
    ShapeGrid const grid = shape_grid(*effect, scales);
    auto const ranges = effect->shape_bounds(scales);
    ASSERT_EQ(grid.axes.size(), ranges.size()) << effect->name();
    with_shape += !ranges.empty();
    for (std::size_t k = 0; k < ranges.size(); ++k) {
      auto const& axis = grid.axes[k];
      double const close = rounding * std::max(std::abs(ranges[k].lower), std::abs(ranges[k].upper));
      EXPECT_NEAR(axis.front(), ranges[k].lower, close) << effect->name();
      if (is_left_to_refinement(*effect, grid, k)) {
        EXPECT_EQ(axis.size(), 1U) << effect->name();
        continue;
      }
      EXPECT_NEAR(axis.back(), ranges[k].upper, close) << effect->name();
      EXPECT_TRUE(std::is_sorted(axis.begin(), axis.end())) << effect->name();
      EXPECT_EQ(std::adjacent_find(axis.begin(), axis.end()), axis.end()) << effect->name() << ": a point twice";
    }
  }
  EXPECT_GT(with_shape, 10);
}

TEST(ShapeGrid, HasEveryCombinationOfTwoShapesAndEveryOtherOfThree) {
  int lattices = 0;
  for (Effect const* effect : effect_choices()) {
    ShapeGrid const grid = shape_grid(*effect, scales_of());
    std::size_t combinations = 1;
    std::ptrdiff_t searched = 0;
    for (auto const& axis : grid.axes) {
      combinations *= axis.size();
      searched += axis.size() > 1;
    }
    bool const is_lattice = searched >= 3;
    lattices += is_lattice;
    ASSERT_EQ(grid.size(), is_lattice ? (combinations + 1) / 2 : combinations) << effect->name();
    if (effect->n_shape() == 0) {
      EXPECT_EQ(grid.size(), 1U) << effect->name();
      EXPECT_TRUE(grid.point(0).empty()) << effect->name();
      continue;
    }
    std::vector<std::vector<double>> points;
    for (std::size_t i = 0; i < grid.size(); ++i) points.push_back(grid.point(i));
    std::sort(points.begin(), points.end());
    EXPECT_EQ(std::adjacent_find(points.begin(), points.end()), points.end()) << effect->name();
  }
  EXPECT_GT(lattices, 2);
}

// in steps of the grid, over drawn shapes
double furthest_from_a_point(ShapeGrid const& grid) {
  RandomStream stream({62, 0, RandomDomain::test}, 0, 0);
  double furthest = 0.0;
  for (int draw = 0; draw < 2000; ++draw) {
    std::vector<double> at;
    for (auto const& axis : grid.axes) at.push_back(stream.uniform() * static_cast<double>(axis.size() - 1));
    double nearest = std::numeric_limits<double>::infinity();
    for (auto const& place : grid.places) {
      double square = 0.0;
      for (std::size_t k = 0; k < at.size(); ++k) square += std::pow(at[k] - static_cast<double>(place[k]), 2);
      nearest = std::min(nearest, square);
    }
    furthest = std::max(furthest, std::sqrt(nearest));
  }
  return furthest;
}

TEST(ShapeGrid, ALatticeLeavesNoShapeFurtherThanOneStep) {
  std::vector<double> const axis{0.0, 0.25, 0.5, 0.75, 1.0};
  ParameterRange const range{0.0, 1.0, Spacing::linear};
  for (std::size_t shapes : {3U, 4U}) {
    ShapeGrid const grid = grid_over({shapes, range}, {shapes, axis}, GridPoints::lattice);
    double const furthest = furthest_from_a_point(grid);
    EXPECT_LE(furthest, 1.0 + 1e-12) << shapes;
    EXPECT_GT(furthest, 0.85) << shapes << ": or the draws are too few";
  }
}

TEST(ShapeGrid, OfAShapeWithoutRoomIsOnePoint) {
  JointScales scales = scales_of();
  scales.peak_speed = 0.0;  // bounds relative to it fall together
  ShapeGrid const grid = shape_grid(*find_effect("stribeck"), scales);
  ASSERT_EQ(grid.axes.size(), 2U);
  ASSERT_EQ(grid.axes[0].size(), 1U);
  EXPECT_EQ(grid.axes[0][0], 0.0);
  EXPECT_GT(grid.axes[1].size(), 1U);
}

TEST(UnitScale, IsUndoneByItsInverse) {
  RandomStream stream({61, 0, RandomDomain::test}, 0, 0);
  for (ParameterRange const& range :
       {ParameterRange{-2.0, 5.0, Spacing::linear}, ParameterRange{1e-4, 30.0, Spacing::logarithmic},
        ParameterRange{0.0, 8.0, Spacing::cubic}}) {
    EXPECT_NEAR(to_unit(range, range.lower), 0.0, rounding);
    EXPECT_NEAR(to_unit(range, range.upper), 1.0, rounding);
    double last = from_unit(range, 0.0);
    for (int i = 1; i <= 100; ++i) {
      double const value = from_unit(range, i / 100.0);
      EXPECT_GT(value, last);
      last = value;
      double const unit = stream.uniform();
      EXPECT_NEAR(to_unit(range, from_unit(range, unit)), unit, rounding);
    }
    // an optimiser's step outside ends at the bound
    EXPECT_DOUBLE_EQ(from_unit(range, -0.3), from_unit(range, 0.0));
    EXPECT_DOUBLE_EQ(from_unit(range, 1.7), from_unit(range, 1.0));
  }
  // the middle of a logarithmic scale is the geometric mean
  EXPECT_NEAR(from_unit({0.01, 100.0, Spacing::logarithmic}, 0.5), 1.0, rounding);
}

// energy of a wave of this angular frequency along x that sine and cosine of another one do not hold
double lost(Eigen::ArrayXd const& x, double wave, double grid_point, double phase) {
  Eigen::MatrixXd basis(x.size(), 2);
  basis << (grid_point * x).sin(), (grid_point * x).cos();
  Eigen::VectorXd const planted = (wave * x + phase).sin();
  Eigen::VectorXd const left = test::left_beside(basis, planted);
  return left.squaredNorm() / planted.squaredNorm();
}

struct Wave {
  char const* effect;
  std::string shape;
  bool is_frequency;  // in Hz over the duration; else in 1/rad over the range
};

std::ostream& operator<<(std::ostream& out, Wave const& wave) { return out << wave.shape; }

double largest_loss(Wave const& wave, JointScales const& scales) {
  Effect const& effect = *find_effect(wave.effect);
  ShapeGrid const grid = shape_grid(effect, scales);
  std::size_t k = 0;
  while (effect.parameters()[effect.n_linear() + k].name != wave.shape) ++k;
  // an evenly spaced motion: time, or a position that is swept at one speed
  double const length = wave.is_frequency ? scales.duration_s : scales.position_range;
  double const to_angular = wave.is_frequency ? 2.0 * std::numbers::pi : 1.0;
  Eigen::Index const samples = 4 * static_cast<Eigen::Index>(to_angular * grid.axes[k].back() * length) + 64;
  Eigen::ArrayXd const x = Eigen::ArrayXd::LinSpaced(samples, -0.5 * length, 0.5 * length);
  double largest = 0.0;
  std::size_t const step = std::max<std::size_t>(1, grid.axes[k].size() / 40);
  for (std::size_t i = 0; i + 1 < grid.axes[k].size(); i += step) {
    double const left = to_angular * grid.axes[k][i], right = to_angular * grid.axes[k][i + 1];
    for (double phase : {0.0, 0.8, 1.6})
      largest = std::max(
          largest, std::min(lost(x, 0.5 * (left + right), left, phase), lost(x, 0.5 * (left + right), right, phase)));
  }
  return largest;
}

class EveryWave : public testing::TestWithParam<Wave> {};

// Half of 0.7 resolutions away a wave of many periods loses 1 - sinc^2(0.35) = 34.3 % of its energy; one of two periods
// up to 2 % more, with its phase.
TEST_P(EveryWave, IsSeenFromTheNearerOfTwoPoints) {
  constexpr double most_lost = 0.343 + 0.02;
  EXPECT_LT(largest_loss(GetParam(), scales_of()), most_lost);
  EXPECT_LT(largest_loss(GetParam(), scales_of(4.3, 0.35)), most_lost) << "short";
  EXPECT_LT(largest_loss(GetParam(), scales_of(31.7, 6.1)), most_lost) << "long";
}

INSTANTIATE_TEST_SUITE_P(Effects, EveryWave,
                         testing::Values(Wave{"periodic_disturbance", "disturbance_frequency", true},
                                         Wave{"cogging", "cogging_order", false},
                                         Wave{"torque_ripple", "torque_ripple_order", false},
                                         Wave{"transmission_error", "transmission_error_order", false},
                                         Wave{"position_dependent_friction", "position_friction_order", false}),
                         [](auto const& one) { return std::string(one.param.effect); });

}  // namespace shape_grid_test
}  // namespace torquescope
