#pragma once
// Concealed torques from outside, loads that come and go, and physics that no catalogue has.
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "stranger/chance.hpp"
#include "stranger/effect.hpp"

namespace stranger {

// a gripper takes a load within half a second: share of the inertia, and its weight
class GrippedLoad : public Effect {
 public:
  GrippedLoad(double share, double at_s, double weight_share, Rig const& rig)
      : share_{share}, at_s_{at_s}, weight_share_{weight_share}, rig_{rig} {}
  double inertia(Moment const& m) const override { return taken(m.t) * share_ * rig_.inertia; }
  double torque(Moment const& m) const override {
    return taken(m.t) * weight_share_ * share_ * rig_.weight * std::sin(m.q - rig_.hang - 0.06);
  }

 private:
  double taken(double t) const {
    double const s = std::clamp((t - at_s_) / 0.5, 0.0, 1.0);
    return s * s * (3 - 2 * s);
  }
  double share_, at_s_, weight_share_;
  Rig rig_;
};

// a person leans on it: quick rise, slow release
class Leaning : public Effect {
 public:
  Leaning(double size, double at_s, double lasts_s) : size_{size}, at_s_{at_s}, lasts_s_{lasts_s} {}
  double torque(Moment const& m) const override {
    double const s = (m.t - at_s_) / lasts_s_;
    if (s <= 0 || s >= 1) return 0;
    return size_ * (s < 0.2 ? s / 0.2 : (1 - s) / 0.8) * (1 + 0.25 * std::sin(23 * s));
  }

 private:
  double size_, at_s_, lasts_s_;
};

// a press next door: a triangle in time
class PressNextDoor : public Effect {
 public:
  PressNextDoor(double size, double hz, Chance chance) : size_{size}, hz_{hz}, phase_{chance.uniform()} {}
  double torque(Moment const& m) const override {
    double const turns = m.t * hz_ + phase_;
    double const s = turns - std::floor(turns);
    return size_ * (s < 0.65 ? 2 * s / 0.65 - 1 : 1 - 2 * (s - 0.65) / 0.35);
  }

 private:
  double size_, hz_, phase_;
};

// a rotor on the same table runs up and down: its frequency sweeps
class RotorRunUp : public Effect {
 public:
  RotorRunUp(double size, double from_hz, double to_hz) : size_{size}, from_hz_{from_hz}, to_hz_{to_hz} {}
  double torque(Moment const&) const override { return size_ * std::sin(phase_); }
  void advance(Moment const& m, double h) override {
    double const s = m.t / 17.0 - std::floor(m.t / 17.0);
    double const up = s < 0.7 ? s / 0.7 : (1 - s) / 0.3;
    phase_ += h * 2 * std::numbers::pi * (from_hz_ + (to_hz_ - from_hz_) * up);
  }

 private:
  double size_, from_hz_, to_hz_, phase_ = 0;
};

// the torque channel drops out for some tens of milliseconds, at random: it shows a share of the torque
class DroppingChannel : public Effect {
 public:
  DroppingChannel(double lost, double per_s, Chance chance) : lost_{lost}, per_s_{per_s}, chance_{chance} {}
  double seen_torque(double torque, double t) override {
    if (t >= next_s_) {
      until_s_ = t + chance_.between(0.03, 0.09);
      next_s_ = until_s_ - std::log(1 - chance_.uniform()) / per_s_;
    }
    return t < until_s_ ? torque * (1 - lost_) : torque;
  }

 private:
  double lost_, per_s_, next_s_ = 0.9, until_s_ = 0;
  Chance chance_;
};

// the film thins by the heat that friction made in the last seconds
class FlashHeat : public Effect {
 public:
  FlashHeat(double share, double time_s, Rig const& rig) : share_{share}, time_s_{time_s}, rig_{rig} {}
  double dry(Moment const&) const override { return -share_ * rig_.dry_forward * heat_ / (1 + heat_); }
  void advance(Moment const& m, double h) override {
    heat_ += h / time_s_ * (std::abs(m.v) / (0.2 * rig_.top_speed) - heat_);
  }

 private:
  double share_, time_s_, heat_ = 0;
  Rig rig_;
};

// the base floats: the weight's direction wanders
class FloatingBase : public Effect {
 public:
  FloatingBase(double size, Rig const& rig, Chance chance) : size_{size}, rig_{rig} {
    for (auto& wave : waves_) wave = {chance.between(0.04, 0.45), chance.between(0, 6.283), chance.between(0.5, 1.0)};
  }
  double torque(Moment const& m) const override {
    double tilt = 0;
    for (auto const& [hz, phase, share] : waves_)
      tilt += size_ * share * std::sin(6.283185307 * hz * m.t * (1 + 0.002 * m.t) + phase);
    double const place = m.q - rig_.hang;
    return rig_.weight * (std::sin(place + tilt) - std::sin(place));
  }

 private:
  struct Wave {
    double hz, phase, share;
  };
  double size_;
  Rig rig_;
  std::array<Wave, 7> waves_{};
};

// magnets brake by eddy currents, but only beside one part of the travel
class EddyBrake : public Effect {
 public:
  EddyBrake(double size, double place, double width) : size_{size}, place_{place}, width_{width} {}
  double viscous(Moment const& m) const override { return size_ / (1 + std::exp(-(m.q - place_) / width_)); }

 private:
  double size_, place_, width_;
};

}  // namespace stranger
