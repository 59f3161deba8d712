#pragma once
// The sizes of one joint in one recording, and bounds written relative to them, so that they transfer between joints.
//
// Why        a Stribeck speed of 0.2 to 20 % of the peak speed means the same on a wrist and on a gantry; 0.01 rad/s
//            does not
// Units      SI; a slide reads m for rad and N for N m
// Threads    plain records and functions of their arguments

#include <string>

#include "engine/robot/joint_kind.hpp"

namespace torquescope {

// -1, 0, 1 weighted by the levels of dry friction of either direction
struct FrictionSign {
  double forward = 1.0, backward = -1.0;
  double operator()(double velocity) const { return velocity > 0.0 ? forward : velocity < 0.0 ? backward : 0.0; }
};

struct JointScales {
  JointKind joint = JointKind::revolute;
  double start_s = 0.0;          // time of the first sample
  double duration_s = 1.0;       //
  double rate_hz = 1000.0;       // of the motion the columns are computed from
  double cutoff_hz = 100.0;      // of the parallel filter: the highest frequency the regression sees
  double peak_speed = 1.0;       // rad/s
  double position_range = 1.0;   // rad, largest minus smallest
  double position_centre = 0.0;  // rad, middle of the range
  double encoder_step = 0.0;     // rad; 0: unknown or too fine to see
  double torque_rms = 1.0;       // N m
  double torque_peak = 1.0;      // N m, largest magnitude
  double torque_highest = 1.0;   // N m, and the largest one below zero, as a magnitude; at least 0
  double torque_lowest = 1.0;
  double coulomb_positive = 0.0;    // N m, magnitude while dq > 0; of the fitted baseline, as all that follow
  double coulomb_negative = 0.0;    // N m, magnitude while dq < 0
  double inertia = 0.0;             // kg m2
  double viscous = 0.0;             // N m s/rad
  double gravity_sin = 0.0;         // N m, of sin(q)
  double gravity_cos = 0.0;         // N m, of cos(q)
  bool bears_only_inertia = false;  // no term of the baseline that a standing joint would carry

  // the smallest length worth asking for: an encoder step, or a millionth of the range
  double resolution() const;
  // mean Coulomb level; 0 when the baseline has none
  double coulomb() const { return 0.5 * (coulomb_positive + coulomb_negative); }
  // sign(dq) times the Coulomb level of that direction over the mean one (1 without Coulomb friction): friction that is
  // modulated keeps the asymmetry the baseline has, else its even part would pass for gravity
  FrictionSign friction_sign() const;
};

enum class RelativeTo {
  absolute,              // SI
  peak_speed,            // rad/s
  position_range,        // rad
  position,              // a place: centre + factor * range; -0.5 and 0.5 are the ends of the travel
  range_inverse2,        // 1/rad2
  resolution,            // rad: encoder step
  duration,              // s
  instant,               // a time: start + factor * duration
  sample_period,         // s
  filter_time,           // s: 1 / (2 pi cutoff)
  slowest_frequency,     // Hz: 1 / duration
  cutoff_frequency,      // Hz
  lowest_order,          // 1/rad: one wave per range
  highest_order,         // 1/rad: wave at the cutoff when the joint moves at a tenth of its peak speed
  torque,                // N m: rms
  torque_peak,           // N m
  torque_highest,        // N m
  torque_lowest,         // N m, as a magnitude
  torque_inverse2,       // 1/(N m)^2
  coulomb,               // N m: mean level of the baseline; without one, the rms torque
  coulomb_per_range,     // N m/rad
  coulomb_per_duration,  // N m/s
  viscous,               // N m s/rad: of the baseline; without one, rms torque at the peak speed
  viscous_per_duration,  // N m/rad
  inertia,  // kg m2: of the baseline; without one, what the rms torque brings to the peak speed in a filter time
  bears_only_inertia,   // 1: the baseline's load is inertia alone; else 0
  torque_per_duration,  // N m/s
  torque_per_speed,     // N m s/rad
  torque_per_speed2,    // N m s2/rad2
  torque_per_speed3,    // N m s3/rad3
  torque_per_range,     // N m/rad
  torque_per_range2,    // N m/rad2
  torque_per_range3,    // N m/rad3
};

struct Bound {
  double factor = 0.0;  // may be infinite: no bound
  RelativeTo to = RelativeTo::absolute;
};

// in the SI unit of the parameter
double bound_value(Bound const& bound, JointScales const& scales);
// "0.2 x peak speed", "0.2 / (2 pi cutoff)", "no bound"
std::string bound_text(Bound const& bound);

}  // namespace torquescope
