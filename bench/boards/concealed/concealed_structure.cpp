// Concealed effects of what hangs on the joint, and of what pushes it from outside.
#include <cmath>
#include <numbers>

#include "concealed/concealed_effects.hpp"
#include "concealed/joint_units.hpp"
#include "concealed/one_turn.hpp"

namespace concealed {

EffectMaker rope_of(double torque_at_range_of_coulomb, double rest_of_range, double rub_share,
                    double distance_of_range) {
  return [=](JointDesign const& joint) -> ConcealedEffect {
    double const range = joint.limits.range, torque = torque_at_range_of_coulomb * joint.baseline.coulomb;
    double const guide = 0.6 * range, slack_length = std::hypot(guide, 0.25 * range);
    double const taut = (std::hypot(guide, range) - slack_length) * range / std::hypot(guide, range);
    return {"cable",
            {"static_position", "reversal"},
            "rope past a guide, slack near its rest, with strands that rub",
            false,
            rope({torque / taut, guide, slack_length, rest_of_range * range, rub_share * torque,
                  distance_of_range * range}),
            {}};
  };
}

EffectMaker hard_stop_of(double torque_at_range_of_coulomb, double place_of_range) {
  return [=](JointDesign const& joint) -> ConcealedEffect {
    double const range = joint.limits.range, place = place_of_range * range;
    double const stiffness = torque_at_range_of_coulomb * joint.baseline.coulomb / std::pow(range - place, 1.5);
    return {"end_stop",
            {"static_position"},
            "depth^1.5 with a loss that fades at the surface",
            false,
            hard_stop(place, stiffness, 0.4 / joint.limits.speed),
            {{"end_stop_position", place, position_unit(joint)}}};
  };
}

EffectMaker gear_error_of(double amplitude_of_range, double order, double phase) {
  return [=](JointDesign const& joint) -> ConcealedEffect {
    Baseline const& base = joint.baseline;
    Link const link{0.7 * base.inertia, base.gravity_sin, base.gravity_cos};
    return {"transmission_error",
            {"order_locked"},
            "exact kinematics of two harmonics",
            false,
            gear_error(amplitude_of_range * joint.limits.range, order, phase, 0.5 * base.viscous, link),
            {{"transmission_error_order", order, order_unit(joint)}}};
  };
}

EffectMaker flexible_gear_of(double load_of_inertia, double frequency_hz, double damping) {
  return [=](JointDesign const& joint) -> ConcealedEffect {
    double const load = load_of_inertia * joint.baseline.inertia, omega = one_turn * frequency_hz;
    double const stiffness = omega * omega * load;
    // wound up by the strokes' acceleration the gear is half as stiff again
    double const wound = joint.limits.speed / speed_up_s / (omega * omega);
    return {"joint_elasticity",
            {"acceleration"},
            "two masses, spring that stiffens",
            false,
            flexible_gear(load, stiffness, std::numbers::sqrt2 * wound, 2.0 * damping * omega * load),
            {{"load_inertia", load, inertia_unit(joint)}}};
  };
}

EffectMaker push_of(double peak_of_coulomb, double start_s, double rise_s) {
  return [=](JointDesign const& joint) -> ConcealedEffect {
    return {"contact",
            {"outside", "time"},
            "comes fast, fades slowly",
            false,
            push(peak_of_coulomb * joint.baseline.coulomb, start_s, rise_s),
            {}};
  };
}

EffectMaker hum_of(double amplitude_of_coulomb, double frequency_hz, double phase) {
  return [=](JointDesign const& joint) -> ConcealedEffect {
    return {"periodic_disturbance",
            {"outside", "order_locked"},
            "amplitude sin(2 pi f t + phase)",
            true,
            hum(amplitude_of_coulomb * joint.baseline.coulomb, frequency_hz, phase),
            {{"disturbance_frequency", frequency_hz, "Hz"}}};
  };
}

EffectMaker picked_up_load_of(double load_of_inertia, double time_s) {
  return [=](JointDesign const& joint) -> ConcealedEffect {
    Baseline const& base = joint.baseline;
    Link const load{load_of_inertia * base.inertia, load_of_inertia * base.gravity_sin,
                    load_of_inertia * base.gravity_cos};
    return {"payload_change",
            {"time", "outside"},
            "inertia and weight from a time on",
            true,
            picked_up_load(time_s, load),
            {{"payload_inertia", load.inertia, inertia_unit(joint)}, {"payload_time", time_s, "s"}}};
  };
}

EffectMaker hidden_shaft_of(double amplitude_of_coulomb, double hz, double turns_per_range) {
  return [=](JointDesign const& joint) -> ConcealedEffect {
    return {"",
            {},
            "unbalanced shaft of another drive behind a slipping belt",
            false,
            hidden_shaft(amplitude_of_coulomb * joint.baseline.coulomb, hz,
                         one_turn * turns_per_range / joint.limits.range),
            {}};
  };
}

EffectMaker supply_sag_of(double share_at_peak_power, double memory_s) {
  return [=](JointDesign const& joint) -> ConcealedEffect {
    double const power = peak_torque(joint) * joint.limits.speed;
    return {"",
            {},
            "supply that sags with the power of the last moments",
            false,
            supply_sag(share_at_peak_power, power, memory_s),
            {}};
  };
}

}  // namespace concealed
