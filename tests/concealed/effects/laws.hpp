#pragma once
// Makers of the hidden effects, one file each. Forms marked (*) are deliberately not those of the engine's catalogue.
//
// Units      SI of the joint: N m, rad or N, m; Hz where the name says so

#include <memory>

#include "concealed/hidden_effect.hpp"

namespace concealed {

using Effect = std::shared_ptr<HiddenEffect const>;

// stribeck (*): dry level + rise / (1 + (v / speed)^2)
Effect lorentzian_stribeck(double rise, double speed);
// stribeck (*): dry level + rise / (1 + |v| / speed)^2
Effect rational_stribeck(double rise, double speed);

// presliding (*): dF/dx = stiffness |1 - s F/level|^2 in place of the Coulomb level; from 0 half of it is reached after
// the distance level / stiffness
Effect bristle_presliding(double coulomb, double stiffness);

// cogging (*): three harmonics of one order, amplitudes first : 0.45 : 0.25
Effect cogging(double amplitude, double order, double phase);

// thermal_friction (*): share * (0.6 exp(-t/fast) + 0.4 exp(-t/slow)) of Coulomb and viscous friction on top when cold
Effect warm_up(double coulomb, double viscous, double share, double fast_s, double slow_s);

// asymmetric_viscous: drag |v|
Effect asymmetric_viscous(double drag);

// gravity: torque sin(q - angle)
Effect gravity(double torque, double angle);
// spring (*): stiffness (x + hardening x^3), x = q - rest
Effect hardening_spring(double stiffness, double rest, double hardening);

// load_dependent_friction (*): share (sqrt(load^2 + round^2) - round), load = inertia a + gravity of the link
struct Link {
  double inertia = 0.0, gravity_sin = 0.0, gravity_cos = 0.0;
};
Effect load_friction(double share, double round, Link const& link);

// backlash (*): a part of the inertia hangs on the motor through a gap of 2 * half_gap with a spring and
// damper at each flank whose damping fades to zero where the flanks part
Effect backlash(double load_inertia, double half_gap, double stiffness, double damping);

// outside the catalogue: magnetorheological drag whose chains build up at rest and break up under shear,
// d(build)/dt = (1 - build) / build_s - break_per_unit |v| build; torque drag build^2 v / sqrt(v^2 + knee^2)
Effect memory_drag(double drag, double build_s, double break_per_unit, double knee);

// outside the catalogue: liquid in a tank on the link, a pendulum whose frequency falls with its amplitude
Effect sloshing_load(double inertia, double frequency_hz, double damping, double limit);

}  // namespace concealed
