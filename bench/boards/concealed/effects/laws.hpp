#pragma once
// Makers of the hidden effects, one file each. Forms marked (*) are deliberately not those of the engine's catalogue.
//
// Units      SI of the joint: N m, rad or N, m; Hz where the name says so

#include <cmath>
#include <cstdint>
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
  bool has_weight() const { return gravity_sin != 0.0 || gravity_cos != 0.0; }
  double weight(double q) const { return has_weight() ? gravity_sin * std::sin(q) + gravity_cos * std::cos(q) : 0.0; }
  double load(Instant const& now) const {
    double const moved = inertia * now.a;
    return has_weight() ? moved + gravity_sin * std::sin(now.q) + gravity_cos * std::cos(now.q) : moved;
  }
};
Effect load_friction(double share, double round, Link const& link);

// backlash (*): a part of the inertia hangs on the motor through a gap of 2 * half_gap with a spring and
// damper at each flank whose damping fades to zero where the flanks part; a film drags it along in the gap
Effect backlash(double load_inertia, double half_gap, double stiffness, double damping, double film = 0.0);

// outside the catalogue: magnetorheological drag whose chains build up at rest and break up under shear,
// d(build)/dt = (1 - build) / build_s - break_per_unit |v| build; torque drag build^2 v / sqrt(v^2 + knee^2)
Effect memory_drag(double drag, double build_s, double break_per_unit, double knee);

// outside the catalogue: liquid in a tank on the link, a pendulum whose frequency falls with its amplitude
Effect sloshing_load(double inertia, double frequency_hz, double damping, double limit);

// outside the catalogue: a shaft of another drive, dragged along through a slipping belt; drag in its angle per q
Effect hidden_shaft(double amplitude, double hz, double drag);
// outside the catalogue: torque that falls by `share` per `power` taken from the supply a while ago
Effect supply_sag(double share, double power, double memory_s);

// speed_drag: quadratic v |v|
Effect speed_drag(double quadratic);
// power_law_viscous (*): Carreau, viscous v (1 + (v / knee)^2)^((exponent - 1) / 2); a power only far above the knee
Effect shear_thinning(double viscous, double knee, double exponent);
// friction_lag (*): a film with one time to thicken and another to thin, on a rational curve
Effect lagging_friction(double rise, double speed, double thicken_s, double thin_s);
// maxwell_slip (*): three smooth elements of unequal strength in place of `strength` of the Coulomb level
Effect slip_elements(double strength, double distance);
// breakaway_dwell (*): grows with the logarithm of the rest, tears over a distance
Effect resting_bond(double rise, double onset_s, double distance);
// position_dependent_friction (*): two harmonics of one order
Effect tight_spots(double amplitude, double order, double phase);
// directional_efficiency (*): one share of the load when driving, another when driven
Effect gear_losses(double driving, double driven, double round, Link const& link);
// friction_drift (*): a random walk
Effect wandering_friction(double amplitude, std::uint64_t seed);

// cable (*): a rope led past a guide, slack at first, and strands that rub
struct RopeDesign {
  double stiffness = 0.0, guide = 0.0, slack_length = 0.0, rest = 0.0;
  double rub = 0.0, distance = 0.0;
};
Effect rope(RopeDesign const& design);
// end_stop (*): depth to the power 1.5 with a loss that fades at the surface; on the positive side
Effect hard_stop(double place, double stiffness, double loss);
// transmission_error (*): exact kinematics of two harmonics
Effect gear_error(double amplitude, double order, double phase, double link_viscous, Link const& link);
// joint_elasticity (*): two masses and a spring that stiffens
Effect flexible_gear(double load_inertia, double stiffness, double knee, double damping);

// torque_ripple (*): two harmonics
Effect torque_ripple(double share, double order, double phase);
// torque_constant (*): motor / sqrt(1 + (motor / knee)^2)
Effect saturation(double knee);
// actuator_lag (*): second order
Effect current_loop(double late_s, double damping);

// contact (*): x^2 exp(2 (1 - x)), x = (t - start) / rise
Effect push(double peak, double start_s, double rise_s);
// periodic_disturbance
Effect hum(double amplitude, double frequency_hz, double phase);
// payload_change
Effect picked_up_load(double time_s, Link const& load);

}  // namespace concealed
