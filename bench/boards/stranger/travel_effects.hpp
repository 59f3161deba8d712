#pragma once
// Concealed torques that belong to the place of the joint.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "stranger/effect.hpp"

namespace stranger {

// the axis stands oblique: size * sin(q + turned)
class ObliqueAxis : public Effect {
 public:
  ObliqueAxis(double size, double turned) : size_{size}, turned_{turned} {}
  double torque(Moment const& m) const override { return size_ * std::sin(m.q + turned_); }

 private:
  double size_, turned_;
};

// a spring that hardens as a fraction does: size * x / (1 - (x/end)^2)
class HardeningSpring : public Effect {
 public:
  HardeningSpring(double size, double rest, double end) : size_{size}, rest_{rest}, end_{end} {}
  double torque(Moment const& m) const override {
    double const x = m.q - rest_;
    double const share = std::clamp(x / end_, -0.97, 0.97);
    return size_ * x / (1 - share * share);
  }

 private:
  double size_, rest_, end_;
};

// a hose: stiffness with a third power, and a Bouc-Wen loop
class Hose : public Effect {
 public:
  Hose(double size, double cubic, double loop, double way) : size_{size}, cubic_{cubic}, loop_{loop}, way_{way} {}
  double torque(Moment const& m) const override { return size_ * (m.q + cubic_ * m.q * m.q * m.q + loop_ * wound_); }
  void advance(Moment const& m, double h) override {
    double const side = m.v > 0 ? 1 : -1;
    wound_ += h * m.v / way_ * (1 - wound_ * wound_ * (0.5 + 0.5 * side * (wound_ > 0 ? 1 : -1)));
  }

 private:
  double size_, cubic_, loop_, way_, wound_ = 0;
};

// a rubber buffer at the upper end (Hunt and Crossley): size * depth^1.5 * (1 + c v), never pulling
class RubberBuffer : public Effect {
 public:
  RubberBuffer(double size, double place, double damping) : size_{size}, place_{place}, damping_{damping} {}
  double torque(Moment const& m) const override {
    double const depth = std::max(0.0, m.q - place_);
    return std::max(0.0, size_ * depth * std::sqrt(depth) * (1 + damping_ * m.v));
  }

 private:
  double size_, place_, damping_;
};

// cogging as a data sheet draws it: trapezoids, one per slot, straight lines between eight points
inline double slot_shape(double turns) {
  static constexpr double points[] = {0.0, 0.75, 1.0, 0.9, 0.1, -0.8, -1.0, -0.75};
  double const place = (turns - std::floor(turns)) * 8;
  int const k = static_cast<int>(place) % 8;
  double const rest = place - std::floor(place);
  return points[k] * (1 - rest) + points[(k + 1) % 8] * rest;
}

class TabulatedCogging : public Effect {
 public:
  TabulatedCogging(double size, double per_unit, double phase) : size_{size}, per_unit_{per_unit}, phase_{phase} {}
  double torque(Moment const& m) const override { return size_ * slot_shape(m.q * per_unit_ + phase_); }

 private:
  double size_, per_unit_, phase_;
};

// the motor's constant waves with the angle
class WavyMotor : public Effect {
 public:
  WavyMotor(double size, double order) : size_{size}, order_{order} {}
  double motor(double asked, Moment const& m) override {
    return asked * (1 + size_ * (std::sin(order_ * m.q) + 0.3 * std::sin(2 * order_ * m.q + 1.1)));
  }

 private:
  double size_, order_;
};

// the load's angle waves about the motor's: q + size/order * (sin(order q) + 0.2 sin(2 order q)); everything behind
// feels its slope
class WavyGear : public Effect {
 public:
  WavyGear(double size, double order) : size_{size}, order_{order} {}
  double gear_slope(double q) const override { return size_ * (std::cos(order_ * q) + 0.4 * std::cos(2 * order_ * q)); }
  double gear_bend(double q) const override {
    return -size_ * order_ * (std::sin(order_ * q) + 0.8 * std::sin(2 * order_ * q));
  }

 private:
  double size_, order_;
};

// the disc of the encoder is off its centre
class OffCentreDisc : public Effect {
 public:
  OffCentreDisc(double size, double phase) : size_{size}, phase_{phase} {}
  double seen_angle(double q) const override { return q + size_ * std::sin(q + phase_); }

 private:
  double size_, phase_;
};

}  // namespace stranger
