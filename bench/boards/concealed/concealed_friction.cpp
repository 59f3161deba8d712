// Concealed effects of friction: of speed, of history, of place, of load, of time.
#include <cmath>
#include <numbers>

#include "concealed/concealed_effects.hpp"
#include "concealed/joint_units.hpp"

namespace concealed {

EffectMaker speed_drag_of(double torque_at_peak_of_coulomb) {
  return [=](JointDesign const& joint) -> ConcealedEffect {
    double const drag = torque_at_peak_of_coulomb * joint.baseline.coulomb / (joint.limits.speed * joint.limits.speed);
    return {"speed_drag",     {"velocity_law"},
            "drag v |v|",     true,
            speed_drag(drag), {{"quadratic_drag", drag, torque_unit(joint) + " s2/" + position_unit(joint) + "2"}}};
  };
}

EffectMaker shear_thinning_of(double torque_at_peak_of_coulomb, double knee_of_peak, double exponent) {
  return [=](JointDesign const& joint) -> ConcealedEffect {
    double const knee = knee_of_peak * joint.limits.speed, x = 1.0 / knee_of_peak;
    double const at_peak = joint.limits.speed * std::pow(1.0 + x * x, 0.5 * (exponent - 1.0));
    return {"power_law_viscous",
            {"velocity_law", "reversal"},
            "viscous v (1 + (v / knee)^2)^((n - 1) / 2)",
            false,
            shear_thinning(torque_at_peak_of_coulomb * joint.baseline.coulomb / at_peak, knee, exponent),
            {}};
  };
}

EffectMaker lagging_friction_of(double rise_of_coulomb, double speed_of_peak, double thicken_s, double thin_s) {
  return [=](JointDesign const& joint) -> ConcealedEffect {
    return {"friction_lag",
            {"velocity_law", "reversal"},
            "film with one time to thicken and another to thin",
            false,
            lagging_friction(rise_of_coulomb * joint.baseline.coulomb, speed_of_peak * joint.limits.speed, thicken_s,
                             thin_s),
            {}};
  };
}

EffectMaker slip_elements_of(double share_of_coulomb, double distance_of_range) {
  return [=](JointDesign const& joint) -> ConcealedEffect {
    return {"maxwell_slip",
            {"reversal"},
            "three Bouc-Wen elements",
            false,
            slip_elements(share_of_coulomb * joint.baseline.coulomb, distance_of_range * joint.limits.range),
            {}};
  };
}

EffectMaker resting_bond_of(double rise_of_coulomb, double onset_s, double distance_of_range) {
  return [=](JointDesign const& joint) -> ConcealedEffect {
    return {"breakaway_dwell",
            {"reversal"},
            "s rise ln(1 + age / onset), the bond tears over a distance",
            false,
            resting_bond(rise_of_coulomb * joint.baseline.coulomb, onset_s, distance_of_range * joint.limits.range),
            {}};
  };
}

EffectMaker tight_spots_of(double amplitude_of_coulomb, double waves_per_travel, double phase) {
  return [=](JointDesign const& joint) -> ConcealedEffect {
    double const order = std::numbers::pi * waves_per_travel / joint.limits.range;
    return {"position_dependent_friction",
            {"static_position", "load"},
            "two harmonics of one order",
            false,
            tight_spots(amplitude_of_coulomb * joint.baseline.coulomb, order, phase),
            {{"position_friction_order", order, order_unit(joint)}}};
  };
}

EffectMaker gear_losses_of(double driving, double driven_of_driving, double round_of_coulomb) {
  return [=](JointDesign const& joint) -> ConcealedEffect {
    Baseline const& base = joint.baseline;
    Link const link{0.9 * base.inertia, base.gravity_sin, base.gravity_cos};
    return {"directional_efficiency",
            {"load"},
            "one share of the load when driving, another when driven",
            false,
            gear_losses(driving, driven_of_driving * driving, round_of_coulomb * base.coulomb, link),
            {}};
  };
}

EffectMaker wandering_friction_of(double step_of_coulomb, std::uint64_t seed) {
  return [=](JointDesign const& joint) -> ConcealedEffect {
    return {"friction_drift",
            {"time"},
            "random walk",
            false,
            wandering_friction(step_of_coulomb * joint.baseline.coulomb, seed),
            {}};
  };
}

}  // namespace concealed
