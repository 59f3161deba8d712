#pragma once
// Concealed faults of drive, transmission and torque channel.
#include <algorithm>
#include <cmath>

#include "stranger/effect.hpp"

namespace stranger {

class SoftShaft : public Effect {  // size: eigenfrequency of the load against the held motor [Hz]
 public:
  SoftShaft(double hz, double damping_ratio, double gap, Rig const& rig) : gap_{gap} {
    double const load = rig.load_share * rig.inertia;
    double const omega = 6.283185307179586 * hz;
    stiffness_ = load * omega * omega;
    damping_ = 2 * damping_ratio * load * omega;
  }
  void build(Structure& s) const override { s.shaft_stiffness = stiffness_, s.shaft_damping = damping_, s.gap = gap_; }

 private:
  double stiffness_ = 0, damping_ = 0, gap_;
};

class Bristles : public Effect {  // LuGre without a Stribeck curve, or many slip elements
 public:
  Bristles(double length, double damping, int elements) : length_{length}, damping_{damping}, elements_{elements} {}
  void build(Structure& s) const override {
    s.bristle_length = length_, s.bristle_damping = damping_, s.slip_elements = elements_;
  }

 private:
  double length_, damping_;
  int elements_;
};

class LateTorque : public Effect {
 public:
  explicit LateTorque(double late_s) : late_s_{late_s} {}
  double torque_lateness() const override { return late_s_; }

 private:
  double late_s_;
};

// the log has the command, the current follows as an underdamped second order
class SecondOrderCurrent : public Effect {
 public:
  SecondOrderCurrent(double time_s, double damping_ratio) : omega_{1 / time_s}, ratio_{damping_ratio} {}
  double motor(double asked, Moment const&) override {
    asked_ = asked;
    return made_;
  }
  void advance(Moment const&, double h) override {
    rate_ += h * (omega_ * omega_ * (asked_ - made_) - 2 * ratio_ * omega_ * rate_);
    made_ += h * rate_;
  }

 private:
  double omega_, ratio_, asked_ = 0, made_ = 0, rate_ = 0;
};

// the iron saturates: i / (1 + (i/i0)^4)^(1/4)
class SaturatedIron : public Effect {
 public:
  explicit SaturatedIron(double knee) : knee_{knee} {}
  double motor(double asked, Moment const&) override {
    double const x = asked / knee_;
    return asked / std::sqrt(std::sqrt(1 + x * x * x * x));
  }

 private:
  double knee_;
};

// the amplifier of the torque channel warms: its zero creeps towards size
class CreepingZero : public Effect {
 public:
  CreepingZero(double size, double time_s) : size_{size}, time_s_{time_s} {}
  double seen_torque(double torque, double t) override { return torque + size_ * -std::expm1(-t / time_s_); }

 private:
  double size_, time_s_;
};

}  // namespace stranger
