// Loads on springs side by side have on every instruction set the bits of the plain recursion of one, straight or
// stiffening, and columns of several shapes those of one shape after the other.

#include "engine/effects/loads_on_spring.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "unit/kernels/every_instruction_set.hpp"

namespace torquescope::load_on_spring {
namespace loads_on_spring_test {

class LoadsOnSpring : public kernels::EveryInstructionSet {};

// of one load, operation by operation
class Alone {
 public:
  explicit Alone(Spring const& spring)
      : omega_(2.0 * std::numbers::pi * spring.frequency_hz),
        decay_(spring.damping * omega_),
        ringing_(omega_ * std::sqrt(1.0 - spring.damping * spring.damping)),
        per_square_(spring.acceleration > 0.0 ? spring.hardening * std::pow(omega_ * omega_ / spring.acceleration, 2)
                                              : 0.0) {}

  void start(double ddq) {
    ddq_ = ddq;
    y_ = -ddq_ / (omega_ * omega_);
  }

  void advance(double ddq, double whole_s) {
    int const parts = std::max(1, per_square_ > 0.0 ? static_cast<int>(std::ceil(omega_ * 5.0 * whole_s)) : 1);
    double const step_s = whole_s / parts, jerk = (ddq - ddq_) / whole_s, square = omega_ * omega_;
    double const faded = std::exp(-decay_ * step_s), cosine = std::cos(ringing_ * step_s);
    double const sine = std::sin(ringing_ * step_s);
    for (int part = 0; part < parts; ++part) {
      dy_ -= 0.5 * step_s * stiffened();
      double const follow = -ddq_ / square + 2.0 * decay_ * jerk / (square * square), dfollow = -jerk / square;
      double const free = y_ - follow, quadrature = (dy_ - dfollow + decay_ * free) / ringing_;
      double const rung = faded * (free * cosine + quadrature * sine);
      dy_ =
          faded * ((quadrature * ringing_ - decay_ * free) * cosine - (free * ringing_ + decay_ * quadrature) * sine) +
          dfollow;
      y_ = rung + follow + dfollow * step_s;
      ddq_ += jerk * step_s;
      dy_ -= 0.5 * step_s * stiffened();
    }
    ddq_ = ddq;
  }

  double pull() const { return -(2.0 * decay_ * dy_ + omega_ * omega_ * y_ + stiffened()) - ddq_; }

 private:
  double stiffened() const { return omega_ * omega_ * y_ * std::min(per_square_ * y_ * y_, 25.0); }

  double omega_, decay_, ringing_, per_square_;
  double ddq_ = 0.0, y_ = 0.0, dy_ = 0.0;
};

std::vector<Spring> const springs{{9.0, 0.01, 0.0, 0.0},
                                  {14.0, 0.1, 2.0, 40.0},
                                  {31.0, 0.2, 8.0, 15.0},
                                  {90.0, 0.02, 1.0, 60.0},
                                  {5.0, 0.005, 0.3, 4.0}};

double acceleration(std::size_t lane, double time_s) {
  double const fast = 60.0 + 11.0 * static_cast<double>(lane);
  return 20.0 * std::sin(17.0 * time_s) + 9.0 * std::sin(fast * time_s);
}

TEST_P(LoadsOnSpring, HaveTheBitsOfOneAloneInEveryLane) {
  constexpr std::size_t lanes = 19;  // no whole number of vectors
  for (Spring const& spring : springs) {
    auto const together = loads_on_spring(spring, lanes);
    std::vector<Alone> alone(lanes, Alone(spring));
    std::array<double, lanes> nothing{}, ddq{}, found{};
    for (int k = 0; k < 500; ++k) {
      double const step_s = k % 3 == 0 ? 1e-3 : 2.5e-3;  // one part, and several
      for (std::size_t lane = 0; lane < lanes; ++lane) {
        ddq[lane] = acceleration(lane, 2e-3 * k);
        if (k == 0)
          alone[lane].start(ddq[lane]);
        else
          alone[lane].advance(ddq[lane], step_s);
      }
      auto const of = [](std::array<double, lanes> const& values) {
        return JointStates::Quantity(values.data(), static_cast<Eigen::Index>(lanes));
      };
      JointStates const at{of(nothing), of(nothing), of(nothing), of(ddq), of(nothing), of(nothing)};
      together->advance(at, step_s);
      together->torques(at, Eigen::ArrayXXd::Constant(static_cast<Eigen::Index>(lanes), 1, 0.7), found);
      for (std::size_t lane = 0; lane < lanes; ++lane) ASSERT_EQ(found[lane], 0.7 * alone[lane].pull()) << k;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Target, LoadsOnSpring, testing::ValuesIn(kernels::supported_instruction_sets()),
                         kernels::instruction_set_of);

class ColumnsOfShapes : public kernels::EveryInstructionSet {};

Motion some_motion() {
  constexpr Eigen::Index n = 1500;
  Motion motion;
  motion.rate_hz = 500.0;
  motion.time_s = Eigen::VectorXd::LinSpaced(n, 0.0, static_cast<double>(n - 1) / motion.rate_hz);
  Eigen::ArrayXd const slow = 5.0 * motion.time_s.array(), fast = 70.0 * motion.time_s.array();
  motion.q = 0.6 * slow.sin() + 0.002 * fast.sin();
  motion.dq = 3.0 * slow.cos() + 0.14 * fast.cos();
  motion.ddq = -15.0 * slow.sin() - 9.8 * fast.sin();
  motion.torque = motion.ddq;
  return motion;
}

TEST_P(ColumnsOfShapes, AreThoseOfOneShapeAfterTheOther) {
  Motion const motion = some_motion();
  JointScales scales;
  scales.inertia = 0.4;
  scales.viscous = 0.8;
  scales.gravity_sin = 3.0;
  scales.torque_rms = 5.0;
  std::vector<double> const torque(motion.torque.data(), motion.torque.data() + motion.torque.size());
  for (auto const& [name, shape] :
       {std::pair{"joint_elasticity", std::vector{9.0, 0.02, 1.0}},
        std::pair{"backlash", std::vector{2e-3, 25.0, 0.1, 5.0, 0.3}},
        std::pair{"breakaway_dwell", std::vector{0.3, 0.01, 0.2}}, std::pair{"presliding", std::vector{0.01}},
        std::pair{"friction_lag", std::vector{0.05, 0.4, 0.5}}}) {
    auto const* effect = find_effect(name);
    auto const linear = static_cast<Eigen::Index>(effect->n_linear());
    std::vector<std::vector<double>> shapes;
    for (int k = 0; k < 11; ++k) {  // no whole number of vectors
      shapes.push_back(shape);
      shapes.back()[k % 2 == 0 ? 0 : shape.size() - 1] *= 1.0 + 0.3 * k;
    }
    shapes.back() = shapes.front();
    EffectInput const input{motion, scales, torque, torque};
    Eigen::MatrixXd together(motion.q.size(), linear * 11), alone(motion.q.size(), linear);
    effect->columns_of_shapes(input, shapes, together);
    for (Eigen::Index k = 0; k < 11; ++k) {
      effect->columns(input, shapes[static_cast<std::size_t>(k)], alone);
      EXPECT_TRUE((together.middleCols(k * linear, linear).array() == alone.array()).all()) << name << " " << k;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Target, ColumnsOfShapes, testing::ValuesIn(kernels::supported_instruction_sets()),
                         kernels::instruction_set_of);

}  // namespace loads_on_spring_test
}  // namespace torquescope::load_on_spring
