// The six rigs of the cases.
#include <stdexcept>

#include "stranger/rig.hpp"

namespace stranger {

Rig find_rig(std::string const& name) {
  Rig rig;
  rig.name = name;
  rig.terms = {"inertia", "viscous", "coulomb", "offset"};
  if (name == "belt") {  // a toothed belt pulls a carriage: metres and newtons
    rig.slides = true;
    rig.inertia = 11.8, rig.viscous = 38, rig.dry_forward = 13.5, rig.dry_backward = 13.5, rig.offset = 0.9;
    rig.torque_limit = 220, rig.torque_rms = 32, rig.centre = 0.41, rig.half_travel = 0.33, rig.top_speed = 0.85;
  } else if (name == "pan") {  // a camera head turns about the vertical
    rig.inertia = 0.0185, rig.viscous = 0.052, rig.dry_forward = 0.083, rig.dry_backward = 0.083, rig.offset = -0.004;
    rig.torque_limit = 2.4, rig.torque_rms = 0.19, rig.centre = 0.3, rig.half_travel = 1.7, rig.top_speed = 3.4;
  } else if (name == "arm") {  // a link under gravity
    rig.inertia = 0.47, rig.viscous = 0.92, rig.dry_forward = 0.85, rig.dry_backward = 0.85, rig.offset = 0.11;
    rig.weight = 5.6, rig.torque_limit = 40, rig.torque_rms = 4.2;
    rig.centre = 0.6, rig.half_travel = 1.25, rig.top_speed = 2.6;
    rig.terms.emplace_back("gravity");
  } else if (name == "gear") {  // a strain-wave gear before a big turntable; friction differs with the direction
    rig.inertia = 7.3, rig.viscous = 21, rig.dry_forward = 16.5, rig.dry_backward = 13.8, rig.offset = 0;
    rig.load_share = 0.55, rig.torque_limit = 210, rig.torque_rms = 31;
    rig.centre = -0.2, rig.half_travel = 1.3, rig.top_speed = 1.3;
    rig.terms = {"inertia", "viscous", "coulomb_positive", "coulomb_negative"};
  } else if (name == "direct") {  // a torque motor without gear: hardly any friction
    rig.inertia = 0.064, rig.viscous = 0.021, rig.dry_forward = 0.034, rig.dry_backward = 0.034, rig.offset = 0.006;
    rig.torque_limit = 9, rig.torque_rms = 0.55, rig.centre = 0, rig.half_travel = 2.6, rig.top_speed = 7;
  } else if (name == "servo") {  // a hobby servo that carries a horn
    rig.inertia = 0.00135, rig.viscous = 0.0125, rig.dry_forward = 0.021, rig.dry_backward = 0.021, rig.offset = 0.0008;
    rig.torque_limit = 0.6, rig.torque_rms = 0.042, rig.centre = 2.1, rig.half_travel = 1.0, rig.top_speed = 3.6;
  } else {
    throw std::invalid_argument("no rig is called " + name);
  }
  return rig;
}

}  // namespace stranger
