#pragma once
// A drawn joint with its drive, its controller and what is read of it. Nothing of the engine.
//
// J dv/dt = given - Fv v - dry friction - offset - g_sin sin(q) - g_cos cos(q) - hidden effects
// Units     rad, s, N m

#include <cstddef>
#include <numbers>
#include <string>
#include <vector>

#include "sticking/chance.hpp"
#include "sticking/dry_friction.hpp"

namespace sticking {

constexpr double turn = 2.0 * std::numbers::pi;
constexpr double step_s = 1e-4;
constexpr double duration_s = 40.0;

struct Joint {
  double inertia = 0.0, viscous = 0.0, dry_forward = 0.0, dry_backward = 0.0, offset = 0.0;
  double gravity_sin = 0.0, gravity_cos = 0.0;
  bool has_gravity = false;
  double dry() const { return 0.5 * (dry_forward + dry_backward); }
  double weight(double q) const;
};

struct Control {
  bool cascade = false;  // P on the position, PI on the speed; else PD
  double rate_hz = 1000.0;
  double position_gain = 0.0, speed_gain = 0.0, integral_gain = 0.0;  // PD: N m/rad, N m s/rad; cascade: 1/s, ...
  double speed_filter_hz = 0.0;
};

struct MotionLimits {
  bool strokes = false;  // strokes with stops; else a sum of sines
  double centre = 0.0, travel = 0.0, speed = 0.0;
  double resting_share = 0.0;  // of the stops of strokes
};

struct Reading {
  double log_hz = 200.0;
  int encoder_bits = 17;
  double encoder_phase = 0.0;  // share of a step between its zero and ours
  bool commanded = false;      // the torque column is the command; else what the drive gives
  double lag_s = 0.0;          // of the drive
  double noise_share = 0.0;    // white noise of the torque column, of the torque's rms
  double encoder_step() const;
};

struct Smoothing {  // [filter] of the job
  bool is_there = false;
  double cutoff_hz = 0.0, parallel_cutoff_hz = 0.0, decimate_to_hz = 0.0;
};

struct Rig {
  Joint joint;
  StickingLaw sticking;
  Control control;
  MotionLimits limits;
  Reading reading;
  Smoothing smoothing;
};

// needs_gravity: of load-dependent friction
Rig draw_rig(Address const& at, bool needs_gravity);

// The commanded position at every tick of the controller
std::vector<double> draw_motion(MotionLimits limits, double rate_hz, Chance chance, bool is_other);

}  // namespace sticking
