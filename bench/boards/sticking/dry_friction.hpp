#pragma once
// How the dry friction of a joint passes through rest, and one step of a body under it.
//
// coulomb       set-valued: the joint holds while what pushes it is below the level, which brakes it when it slides
// creep         level tanh(v / speed): no rest at all
// dahl          F = s0 z, dz/dt = v - |v| s0 z / level, s0 = level / length
// lugre         F = s0 z + s1 dz/dt, the same dz/dt; no rise at low speed
// elastoplastic lugre whose bristles do not slip at all below a share `elastic` of their greatest bend
// Units         rad, rad/s, N m; the level may change from step to step (effects do that)
// Source        Dahl 1968; Canudas de Wit, Olsson, Astrom, Lischinsky 1995, doi:10.1109/9.376053; Dupont, Hayward,
//               Armstrong, Altpeter 2002, doi:10.1109/TAC.2002.1000274

#include <string>

namespace sticking {

enum class Law { coulomb, creep, dahl, elastoplastic, lugre };

struct StickingLaw {
  Law law = Law::coulomb;
  double speed = 0.0;    // of creep
  double length = 0.0;   // of bristles
  double damping = 0.0;  // s1, share of the critical damping of inertia and bristles
  double elastic = 0.0;  // of elastoplastic
  bool has_bristles() const { return law != Law::coulomb && law != Law::creep; }
};

std::string to_text(Law law);

struct Body {
  double inertia = 0.0, viscous = 0.0;
};

class DryFriction {
 public:
  // usual_level: sets the stiffness of bristles; seconds: of a step, which stiff bristles divide into several
  DryFriction(StickingLaw law, Body body, double usual_level, double seconds);
  // The speed at the end of a step that began with speed v under torque; the mean friction goes to torque()
  double step(double v, double torque, double level_forward, double level_backward);
  double torque() const { return torque_; }

 private:
  double hold_or_slide(double v, double torque, double forward, double backward);
  double creep(double v, double torque, double forward, double backward);
  double bend(double v, double torque, double forward, double backward);
  double slipping(double v, double greatest_bend) const;

  StickingLaw law_;
  Body body_;
  double step_s_;
  int parts_ = 1;
  double stiffness_ = 0.0, damping_ = 0.0;
  double bend_ = 0.0, bristles_ = 0.0;  // bend in rad, and the torque that the bristles have now
  double torque_ = 0.0;
};

}  // namespace sticking
