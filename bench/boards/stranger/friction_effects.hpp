#pragma once
// Concealed friction: what the dry and viscous levels depend on beside the direction.
#include <algorithm>
#include <cmath>

#include "stranger/effect.hpp"

namespace stranger {

// Lorentzian instead of exponential: added level = size / (1 + (v/vs)^2)
class LorentzStribeck : public Effect {
 public:
  LorentzStribeck(double size, double speed) : size_{size}, speed_{speed} {}
  double dry(Moment const& m) const override { return size_ / (1 + (m.v / speed_) * (m.v / speed_)); }

 private:
  double size_, speed_;
};

// cubic when slow, quadratic when fast: windage
class Windage : public Effect {
 public:
  Windage(double size, double speed) : size_{size}, speed_{speed} {}
  double torque(Moment const& m) const override { return size_ * m.v * m.v * m.v / (speed_ + std::abs(m.v)); }

 private:
  double size_, speed_;
};

// Eyring: a lubricant that thins, size * asinh(v/v0)
class ThinningGrease : public Effect {
 public:
  ThinningGrease(double size, double speed) : size_{size}, speed_{speed} {}
  double torque(Moment const& m) const override { return size_ * std::asinh(m.v / speed_); }

 private:
  double size_, speed_;
};

// rounded V: more losses in one direction, size * (sqrt(v^2 + v0^2) - v0)
class OneSidedLoss : public Effect {
 public:
  OneSidedLoss(double size, double speed) : size_{size}, speed_{speed} {}
  double torque(Moment const& m) const override { return size_ * (std::hypot(m.v, speed_) - speed_); }

 private:
  double size_, speed_;
};

// ageing contacts: level grows with the logarithm of the rest and is worn off over a short way
class AgeingContact : public Effect {
 public:
  AgeingContact(double size, double time_s, double way) : size_{size}, time_s_{time_s}, way_{way} {}
  double dry(Moment const& m) const override {
    return size_ * std::log1p(m.resting / time_s_) * std::exp(-m.slid / way_);
  }

 private:
  double size_, time_s_, way_;
};

// a tight spot of the guide: a bump of the dry friction
class TightSpot : public Effect {
 public:
  TightSpot(double size, double place, double width) : size_{size}, place_{place}, width_{width} {}
  double dry(Moment const& m) const override {
    double const x = (m.q - place_) / width_;
    return size_ / (1 + x * x * x * x);
  }

 private:
  double size_, place_, width_;
};

// bearings pressed by the weight: size * |weight torque|
class PressedBearing : public Effect {
 public:
  PressedBearing(double size, Rig const& rig) : size_{size}, rig_{rig} {}
  double dry(Moment const& m) const override {
    return size_ * std::abs(rig_.weight * std::sin(m.q - rig_.hang) + rig_.load_share * rig_.inertia * m.a);
  }

 private:
  double size_;
  Rig rig_;
};

// a worm: the flank's losses take a share of the load torque when driving, another when driven
class WormFlank : public Effect {
 public:
  WormFlank(double driving, double driven, Rig const& rig) : driving_{driving}, driven_{driven}, rig_{rig} {}
  double dry(Moment const& m) const override {
    double const load = rig_.weight * std::sin(m.q - rig_.hang) + rig_.load_share * rig_.inertia * m.a;
    double const side = load * m.v / (std::abs(load * m.v) + 1e-9);
    return std::abs(load) * (side > 0 ? driving_ : driven_);
  }

 private:
  double driving_, driven_;
  Rig rig_;
};

// warming up with two times, a housing and its oil: both levels fall by share * (0.65 quick + 0.35 slow)
class WarmingGear : public Effect {
 public:
  WarmingGear(double share, double quick_s, double slow_s, Rig const& rig)
      : share_{share}, quick_s_{quick_s}, slow_s_{slow_s}, rig_{rig} {}
  double dry(Moment const& m) const override { return share_ * cold(m.t) * rig_.dry_forward; }
  double viscous(Moment const& m) const override { return share_ * 1.4 * cold(m.t) * rig_.viscous; }

 private:
  double cold(double t) const { return 0.65 * std::exp(-t / quick_s_) + 0.35 * std::exp(-t / slow_s_); }
  double share_, quick_s_, slow_s_;
  Rig rig_;
};

// a screw of the preload gives way: the level falls within some seconds, and stays
class LooseScrew : public Effect {
 public:
  LooseScrew(double size, double from_s, double lasts_s) : size_{size}, from_s_{from_s}, lasts_s_{lasts_s} {}
  double dry(Moment const& m) const override { return -size_ * std::clamp((m.t - from_s_) / lasts_s_, 0.0, 1.0); }

 private:
  double size_, from_s_, lasts_s_;
};

}  // namespace stranger
