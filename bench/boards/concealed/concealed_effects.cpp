#include "concealed/concealed_effects.hpp"

#include <cmath>

#include "concealed/joint_units.hpp"
#include "concealed/one_turn.hpp"

namespace concealed {

EffectMaker lorentzian_stribeck_of(double rise_of_coulomb, double speed_of_peak) {
  return [=](JointDesign const& joint) -> ConcealedEffect {
    double const rise = rise_of_coulomb * joint.baseline.coulomb;
    return {"stribeck",
            {"reversal", "velocity_law"},
            "s rise / (1 + (v / speed)^2)",
            false,
            lorentzian_stribeck(rise, speed_of_peak * joint.limits.speed),
            {{"stribeck", rise, torque_unit(joint)}}};
  };
}

EffectMaker rational_stribeck_of(double rise_of_coulomb, double speed_of_peak) {
  return [=](JointDesign const& joint) -> ConcealedEffect {
    double const rise = rise_of_coulomb * joint.baseline.coulomb;
    return {"stribeck",
            {"reversal", "velocity_law"},
            "s rise / (1 + |v| / speed)^2",
            false,
            rational_stribeck(rise, speed_of_peak * joint.limits.speed),
            {{"stribeck", rise, torque_unit(joint)}}};
  };
}

EffectMaker presliding_of(double distance_of_range) {
  return [=](JointDesign const& joint) -> ConcealedEffect {
    double const coulomb = joint.baseline.coulomb;
    double const stiffness = coulomb / (distance_of_range * joint.limits.range);
    return {"presliding",
            {"reversal"},
            "dF/dx = stiffness |1 - s F / coulomb|^2",
            false,
            bristle_presliding(coulomb, stiffness),
            {{"presliding", coulomb, torque_unit(joint)}}};
  };
}

EffectMaker backlash_of(double load_of_inertia, double half_gap_of_range, double contact_hz, double film_per_s) {
  return [=](JointDesign const& joint) -> ConcealedEffect {
    double const load = load_of_inertia * joint.baseline.inertia;
    double const motor = joint.baseline.inertia - load;
    double const half_gap = half_gap_of_range * joint.limits.range;
    double const omega = one_turn * contact_hz;
    double const stiffness = omega * omega * load * motor / (load + motor);
    // a blow at a tenth of the peak speed loses about half of its speed (Hunt, Crossley: 1 - e = 2/3 damping/stiffness
    // v)
    double const damping = 0.75 * stiffness / (0.1 * joint.limits.speed);
    return {"backlash",
            {"reversal"},
            "two masses, gap, Hunt-Crossley flanks",
            false,
            backlash(load, half_gap, stiffness, damping, film_per_s * load),
            {{"backlash_half_gap", half_gap, position_unit(joint)}}};
  };
}

EffectMaker cogging_of(double amplitude_of_coulomb, double order) {
  return [=](JointDesign const& joint) -> ConcealedEffect {
    return {"cogging",
            {"order_locked"},
            "three harmonics of one order",
            false,
            cogging(amplitude_of_coulomb * joint.baseline.coulomb, order, 0.4),
            {{"cogging_order", order, "1/" + position_unit(joint)}}};
  };
}

EffectMaker warm_up_of(double share, double fast_s, double slow_s) {
  return [=](JointDesign const& joint) -> ConcealedEffect {
    return {"thermal_friction",
            {"time"},
            "two time constants, 0.6 and 0.4",
            false,
            warm_up(joint.baseline.coulomb, joint.baseline.viscous, share, fast_s, slow_s),
            {{"thermal_coulomb", share * joint.baseline.coulomb, torque_unit(joint)}}};
  };
}

EffectMaker asymmetric_viscous_of(double drag_of_viscous) {
  return [=](JointDesign const& joint) -> ConcealedEffect {
    double const drag = drag_of_viscous * joint.baseline.viscous;
    return {"asymmetric_viscous",
            {"velocity_law"},
            "drag |v|",
            true,
            asymmetric_viscous(drag),
            {{"asymmetric_viscous", drag, torque_unit(joint) + " s/" + position_unit(joint)}}};
  };
}

EffectMaker gravity_of(double torque_of_coulomb, double angle_rad) {
  return [=](JointDesign const& joint) -> ConcealedEffect {
    double const torque = torque_of_coulomb * joint.baseline.coulomb;
    return {"gravity",
            {"static_position"},
            "torque sin(q - angle)",
            true,
            gravity(torque, angle_rad),
            {{"gravity_sin", torque * std::cos(angle_rad), torque_unit(joint)},
             {"gravity_cos", -torque * std::sin(angle_rad), torque_unit(joint)}}};
  };
}

EffectMaker spring_of(double torque_at_range_of_coulomb, double rest_of_range, double hardening) {
  return [=](JointDesign const& joint) -> ConcealedEffect {
    double const range = joint.limits.range;
    double const stiffness = torque_at_range_of_coulomb * joint.baseline.coulomb / range;
    return {"spring",
            {"static_position"},
            "stiffness x (1 + hardening x^2)",
            false,
            hardening_spring(stiffness, rest_of_range * range, hardening / (range * range)),
            {{"spring", stiffness, torque_unit(joint) + "/" + position_unit(joint)}}};
  };
}

EffectMaker load_friction_of(double share, double round_of_coulomb) {
  return [=](JointDesign const& joint) -> ConcealedEffect {
    Baseline const& base = joint.baseline;
    Link const link{0.9 * base.inertia, base.gravity_sin, base.gravity_cos};
    return {"load_dependent_friction",
            {"load"},
            "s share (sqrt(load^2 + round^2) - round)",
            false,
            load_friction(share, round_of_coulomb * base.coulomb, link),
            {{"load_dependent_friction", share, "1"}}};
  };
}

EffectMaker memory_drag_of(double drag_of_coulomb, double build_s, double break_at_peak_hz, double knee_of_peak) {
  return [=](JointDesign const& joint) -> ConcealedEffect {
    double const speed = joint.limits.speed;
    return {
        "",
        {},
        "magnetorheological drag with memory",
        false,
        memory_drag(drag_of_coulomb * joint.baseline.coulomb, build_s, break_at_peak_hz / speed, knee_of_peak * speed),
        {}};
  };
}

EffectMaker sloshing_of(double load_of_inertia, double frequency_hz, double limit_of_range) {
  return [=](JointDesign const& joint) -> ConcealedEffect {
    return {"",
            {},
            "liquid whose frequency falls with its amplitude",
            false,
            sloshing_load(load_of_inertia * joint.baseline.inertia, frequency_hz, 0.03,
                          limit_of_range * joint.limits.range),
            {}};
  };
}

}  // namespace concealed
