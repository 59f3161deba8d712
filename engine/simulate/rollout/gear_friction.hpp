#pragma once
// Dry friction of a gear beside the joint's own: what grows with the load on its teeth, falls with speed, or turns with
// its angle.
//
// Equation   F = load l + load_square l^2 + (stribeck + load_stribeck l) b(dq) + angle_cos cos q + angle_sin sin q,
//              l = |motor_share motor + (1 - motor_share) weight|,
//              b(v) = (1 + (v / stribeck_speed)^2 / 16)^-16, which is exp(-(v / stribeck_speed)^2) within 0.03
// Load       motor: the torque of the motor; weight: the torque that would hold the joint. Held at rest both are equal
// Held       from tick to tick; it adds to the level at which dry friction holds or slides
// Units      SI: load 1, load_square 1/(N m), stribeck N m, load_stribeck 1, stribeck_speed rad/s,
//            angle_cos, angle_sin N m
// Threads    plain record
// Source     Duclusaud, Passault, Padois, Ly 2025, ICRA, models M3 to M6 (arXiv:2410.08650); Stribeck: Armstrong,
//            Dupont, Canudas de Wit 1994, doi:10.1016/0005-1098(94)90209-7

namespace torquescope {

struct GearFriction {
  double load = 0.0, load_square = 0.0;
  double stribeck = 0.0, load_stribeck = 0.0, stribeck_speed = 0.1;
  double motor_share = 0.5;
  double angle_cos = 0.0, angle_sin = 0.0;

  bool turns() const { return angle_cos != 0.0 || angle_sin != 0.0; }
  bool is_none() const {
    return load == 0.0 && load_square == 0.0 && stribeck == 0.0 && load_stribeck == 0.0 && !turns();
  }
};

}  // namespace torquescope
