// Concealed effects of motor, drive and instruments.
#include <cmath>

#include "concealed/closed_loop.hpp"
#include "concealed/concealed_effects.hpp"
#include "concealed/joint_units.hpp"

namespace concealed {

double peak_torque(JointDesign const& joint) {
  Baseline const& base = joint.baseline;
  return base.inertia * joint.limits.speed / speed_up_s + base.viscous * joint.limits.speed + base.coulomb +
         std::hypot(base.gravity_sin, base.gravity_cos);
}

EffectMaker torque_ripple_of(double share, double order, double phase) {
  return [=](JointDesign const& joint) -> ConcealedEffect {
    return {"torque_ripple", {"order_locked", "load"},           "motor torque times two harmonics",
            false,           torque_ripple(share, order, phase), {{"torque_ripple_order", order, order_unit(joint)}}};
  };
}

EffectMaker saturation_of(double share_lost_at_peak) {
  return [=](JointDesign const& joint) -> ConcealedEffect {
    double const kept = 1.0 - share_lost_at_peak;
    return {"torque_constant",
            {"load"},
            "motor / sqrt(1 + (motor / knee)^2)",
            false,
            saturation(peak_torque(joint) / std::sqrt(1.0 / (kept * kept) - 1.0)),
            {}};
  };
}

EffectMaker current_loop_of(double late_s, double damping) {
  return [=](JointDesign const&) -> ConcealedEffect {
    return {"actuator_lag", {"acceleration", "reversal"},  "current loop of second order",
            false,          current_loop(late_s, damping), {{"actuator_lag", late_s, "s"}}};
  };
}

EffectMaker late_torque_of(double delay_s) {
  return [=](JointDesign const&) -> ConcealedEffect {
    return {"delay",
            {"acceleration", "reversal", "measurement"},
            "torque of a time ago",
            true,
            nullptr,
            {{"delay", delay_s, "s"}},
            late_torque(delay_s, tick_s)};
  };
}

EffectMaker limited_torque_of(double lowest_of_peak, double highest_of_peak) {
  return [=](JointDesign const& joint) -> ConcealedEffect {
    double const peak = peak_torque(joint);
    return {"clipping",
            {"measurement", "load"},
            "unequal limits",
            false,
            nullptr,
            {},
            limited_torque(-lowest_of_peak * peak, highest_of_peak * peak)};
  };
}

EffectMaker creeping_zero_of(double creep_of_coulomb, double settle_s, double jump_of_creep, double jump_s) {
  return [=](JointDesign const& joint) -> ConcealedEffect {
    double const creep = creep_of_coulomb * joint.baseline.coulomb;
    return {"sensor_drift",
            {"time", "static_position", "measurement"},
            "settles exponentially and jumps",
            false,
            nullptr,
            {},
            creeping_zero(creep, settle_s, jump_of_creep * creep, jump_s)};
  };
}

EffectMaker eccentric_disc_of(double error_rad, double phase) {
  return [=](JointDesign const&) -> ConcealedEffect {
    return {"encoder_eccentricity",
            {"order_locked", "measurement"},
            "disc off its centre that wobbles",
            false,
            nullptr,
            {},
            eccentric_disc(error_rad, phase)};
  };
}

}  // namespace concealed
