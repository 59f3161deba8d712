#pragma once
// One piece of physics that a case conceals. An effect overrides what it touches; everything else does nothing.
//
// Sign      torque() is what the joint must be driven with beyond the rigid-body model: it brakes where it has the sign
//           of v
// Units     those of the rig
// Threads   has state; one object per recording
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "stranger/rig.hpp"

namespace stranger {

// what an effect may see of the joint at this instant
struct Moment {
  double t = 0, q = 0, v = 0, a = 0;
  double drive = 0;    // torque of the motor
  double resting = 0;  // [s] since it came to rest
  double slid = 0;     // [rad or m] since it broke away
};

// how the joint is put together; effects of the structure change it before the start
struct Structure {
  double shaft_stiffness = 0;  // 0: one rigid body
  double shaft_damping = 0;
  double gap = 0;             // half the lost motion of the shaft
  double bristle_length = 0;  // deflection at which friction before sliding is full; 0: Coulomb
  double bristle_damping = 0;
  int slip_elements = 0;  // 0: none; then bristle_length is the mean of their lengths
};

struct ConcealedLaw {
  std::string name;            // of the catalogue, or "outside"
  std::string form;            // the law in words
  std::vector<double> values;  // the first is the size
};

class Effect {
 public:
  virtual ~Effect() = default;
  virtual void build(Structure&) const {}
  virtual double torque(Moment const&) const { return 0; }
  virtual double dry(Moment const&) const { return 0; }      // added level of dry friction
  virtual double viscous(Moment const&) const { return 0; }  // added coefficient
  virtual double inertia(Moment const&) const { return 0; }
  virtual double motor(double asked, Moment const&) { return asked; }  // torque that the motor makes of what is asked
  virtual double gear_slope(double) const { return 0; }                // d(load angle)/dq - 1
  virtual double gear_bend(double) const { return 0; }                 // its derivative
  virtual double seen_angle(double q) const { return q; }
  virtual double seen_torque(double torque, double) { return torque; }
  virtual double torque_lateness() const { return 0; }  // [s]
  virtual void advance(Moment const&, double) {}
};

std::unique_ptr<Effect> make_effect(ConcealedLaw const& law, Rig const& rig, std::string const& case_name);

}  // namespace stranger
