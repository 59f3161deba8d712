#pragma once
// The moving joint. Dry friction is a set-valued law, solved exactly in every step: nothing is smoothed around rest.
//
// Equation   (J + J_load s^2) a = u + w - Fv v - F - offset - weight - what is concealed;   s = 1 + slope of the gear's
//            error
// Method     velocity first, dry friction by its proximal step, then position (trapezoid); first order in the step
#include <memory>
#include <vector>

#include "stranger/effect.hpp"
#include "stranger/rig.hpp"

namespace stranger {

class Plant {
 public:
  Plant(Rig rig, std::vector<std::unique_ptr<Effect>>& effects);
  // the motor is asked for a torque, w pushes from outside
  void step(double asked, double w, double h);
  double angle() const { return at_.q; }
  double speed() const { return at_.v; }
  double time() const { return at_.t; }
  double angle_seen() const;
  // torque that the rigid-body model cannot explain, of what was asked in the last step
  double unexplained() const { return unexplained_; }
  double kinetic_energy() const;
  double lost_energy() const { return lost_; }      // taken by friction
  double driven_energy() const { return driven_; }  // given by motor and w

 private:
  double bristle_force(double level, double h);
  double shaft_torque() const;
  void step_load(double torque, double h);

  Rig rig_;
  std::vector<std::unique_ptr<Effect>>& effects_;
  Structure structure_;
  Moment at_;
  double load_q_ = 0, load_v_ = 0;
  double bristle_ = 0;
  std::vector<double> elements_;
  double unexplained_ = 0, lost_ = 0, driven_ = 0;
};

}  // namespace stranger
