#include "concealed/drawable_effects.hpp"

#include <cmath>
#include <stdexcept>

#include "concealed/drawn_rig.hpp"
#include "concealed/one_turn.hpp"

namespace concealed {
namespace {

double log_between(Random& random, double low, double high) {
  return std::exp(random.between(std::log(low), std::log(high)));
}

// poles and teeth: whole numbers per turn of the encoder; a slide's screw or pulley turns once per lead
double drawn_order(Random& random, JointDesign const& joint, int fewest, int most) {
  int const counts = fewest + static_cast<int>(random.index(static_cast<std::size_t>(most - fewest + 1)));
  return joint.revolute ? counts : (1 + counts % 3) * one_turn / joint.travel_per_turn;
}

double drawn_angle(Random& random) { return random.between(0.0, one_turn); }

// shapes of friction
std::vector<DrawableEffect> friction() {
  auto const& any = all_joint_names();
  return {
      {"asymmetric_viscous", any, 0.05, 0.6,
       [](Random&, JointDesign const&) -> Amplifier { return asymmetric_viscous_of; }},
      {"stribeck", any, 0.1, 1.5,
       [](Random& r, JointDesign const&) -> Amplifier {
         double const speed = log_between(r, 0.012, 0.08);
         if (r.uniform() < 0.5) return [=](double x) { return lorentzian_stribeck_of(x, speed); };
         return [=](double x) { return rational_stribeck_of(x, speed); };
       }},
      {"speed_drag", any, 0.1, 2.0, [](Random&, JointDesign const&) -> Amplifier { return speed_drag_of; }},
      {"power_law_viscous", any, 0.3, 5.0,
       [](Random& r, JointDesign const&) -> Amplifier {
         double const knee = log_between(r, 0.01, 0.05), exponent = r.between(0.3, 0.6);
         return [=](double x) { return shear_thinning_of(x, knee, exponent); };
       }},
      {"presliding", any, 1e-3, 0.02, [](Random&, JointDesign const&) -> Amplifier { return presliding_of; }},
      {"maxwell_slip", any, 0.2, 0.9,
       [](Random& r, JointDesign const&) -> Amplifier {
         double const distance = log_between(r, 0.004, 0.03);
         return [=](double x) { return slip_elements_of(x, distance); };
       }},
      {"breakaway_dwell", any, 0.1, 0.6,
       [](Random& r, JointDesign const&) -> Amplifier {
         double const onset_s = log_between(r, 0.01, 0.1), distance = log_between(r, 0.004, 0.02);
         return [=](double x) { return resting_bond_of(x, onset_s, distance); };
       }},
      {"friction_lag", any, 0.3, 2.0,
       [](Random& r, JointDesign const&) -> Amplifier {
         double const speed = log_between(r, 0.03, 0.2), thicken_s = log_between(r, 0.02, 0.06);
         double const thin_s = thicken_s * r.between(0.3, 0.7);
         return [=](double x) { return lagging_friction_of(x, speed, thicken_s, thin_s); };
       }},
      {"position_dependent_friction", any, 0.05, 0.5,
       [](Random& r, JointDesign const&) -> Amplifier {
         double const waves = r.between(0.8, 4.0), phase = drawn_angle(r);
         return [=](double x) { return tight_spots_of(x, waves, phase); };
       }},
      {"load_dependent_friction", any, 0.05, 0.4,
       [](Random& r, JointDesign const&) -> Amplifier {
         double const round = r.between(0.1, 0.4);
         return [=](double x) { return load_friction_of(x, round); };
       }},
      {"directional_efficiency", any, 0.05, 0.3,
       [](Random& r, JointDesign const&) -> Amplifier {
         double const driven = r.between(1.4, 2.5), round = r.between(0.1, 0.4);
         return [=](double x) { return gear_losses_of(x, driven, round); };
       }},
      {"thermal_friction", any, 0.1, 1.0,
       [](Random& r, JointDesign const&) -> Amplifier {
         double const fast_s = r.between(5.0, 15.0), slow_s = r.between(30.0, 90.0);
         return [=](double x) { return warm_up_of(x, fast_s, slow_s); };
       }},
      {"friction_drift", any, 0.03, 0.3,
       [](Random& r, JointDesign const&) -> Amplifier {
         auto const seed = static_cast<std::uint64_t>(r.index(1u << 30));
         return [=](double x) { return wandering_friction_of(x, seed); };
       }},
  };
}

// what hangs on the joint, and the gear in between
std::vector<DrawableEffect> structure() {
  auto const& any = all_joint_names();
  return {
      // a joint whose weight is known would swallow it
      {"gravity",
       {"elbow", "wrist", "base"},
       0.05,
       3.0,
       [](Random& r, JointDesign const&) -> Amplifier {
         double const angle = drawn_angle(r);
         return [=](double x) { return gravity_of(x, angle); };
       }},
      {"spring", any, 0.1, 3.0,
       [](Random& r, JointDesign const&) -> Amplifier {
         double const rest = r.between(-0.4, 0.4), hardening = r.between(0.1, 0.4);
         return [=](double x) { return spring_of(x, rest, hardening); };
       }},
      {"cable", any, 0.2, 3.0,
       [](Random& r, JointDesign const&) -> Amplifier {
         double const rest = r.between(-0.3, 0.3), rub = r.between(0.15, 0.35), distance = r.between(0.05, 0.2);
         return [=](double x) { return rope_of(x, rest, rub, distance); };
       }},
      {"end_stop", any, 0.3, 20.0,
       [](Random& r, JointDesign const&) -> Amplifier {
         double const place = r.between(0.55, 0.8);
         return [=](double x) { return hard_stop_of(x, place); };
       }},
      {"transmission_error", any, 1e-4, 4e-3,
       [](Random& r, JointDesign const& joint) -> Amplifier {
         double const order = drawn_order(r, joint, 6, 30), phase = drawn_angle(r);
         return [=](double x) { return gear_error_of(x, order, phase); };
       }},
      {"joint_elasticity", any, 0.3, 0.85,
       [](Random& r, JointDesign const&) -> Amplifier {
         double const frequency_hz = log_between(r, 5.0, 14.0), damping = log_between(r, 0.01, 0.06);
         return [=](double x) { return flexible_gear_of(x, frequency_hz, damping); };
       }},
      // however small the gap, what hangs behind it swings on its flanks: the size is in the load
      {"backlash", any, 0.1, 0.6,
       [](Random& r, JointDesign const&) -> Amplifier {
         double const half_gap = log_between(r, 3e-4, 2e-3), contact_hz = r.between(50.0, 100.0);
         double const film_per_s = r.between(25.0, 50.0);
         return [=](double x) { return backlash_of(x, half_gap, contact_hz, film_per_s); };
       }},
      {"contact", any, 0.3, 8.0,
       [](Random& r, JointDesign const&) -> Amplifier {
         double const start_s = r.between(8.0, 30.0), rise_s = r.between(0.1, 0.5);
         double const side = r.uniform() < 0.5 ? -1.0 : 1.0;
         return [=](double x) { return push_of(side * x, start_s, rise_s); };
       }},
      {"payload_change", any, 0.1, 3.0,
       [](Random& r, JointDesign const&) -> Amplifier {
         double const time_s = r.between(10.0, 28.0);
         return [=](double x) { return picked_up_load_of(x, time_s); };
       }},
      {"periodic_disturbance", any, 0.02, 0.6,
       [](Random& r, JointDesign const&) -> Amplifier {
         double const frequency_hz = log_between(r, 1.5, 15.0), phase = drawn_angle(r);
         return [=](double x) { return hum_of(x, frequency_hz, phase); };
       }},
  };
}

// motor, drive and instruments
std::vector<DrawableEffect> drive() {
  auto const& any = all_joint_names();
  return {
      {"cogging", any, 0.02, 0.5,
       [](Random& r, JointDesign const& joint) -> Amplifier {
         double const order = drawn_order(r, joint, 8, 40);
         return [=](double x) { return cogging_of(x, order); };
       }},
      {"torque_ripple", any, 0.03, 0.3,
       [](Random& r, JointDesign const& joint) -> Amplifier {
         double const order = drawn_order(r, joint, 6, 36), phase = drawn_angle(r);
         return [=](double x) { return torque_ripple_of(x, order, phase); };
       }},
      {"delay", any, 2e-3, 0.03, [](Random&, JointDesign const&) -> Amplifier { return late_torque_of; }},
      {"actuator_lag", any, 2e-3, 0.012,
       [](Random& r, JointDesign const&) -> Amplifier {
         double const damping = r.between(0.6, 0.9);
         return [=](double x) { return current_loop_of(x, damping); };
       }},
      {"torque_constant", any, 0.05, 0.6, [](Random&, JointDesign const&) -> Amplifier { return saturation_of; }},
      // the more, the lower the limits
      {"clipping", any, 0.4, 4.0,
       [](Random& r, JointDesign const&) -> Amplifier {
         double const unequal = r.between(0.8, 0.95);
         return [=](double x) { return limited_torque_of(1.0 / (1.0 + x), 1.0 / (1.0 + unequal * x)); };
       }},
      {"sensor_drift", any, 0.05, 2.0,
       [](Random& r, JointDesign const&) -> Amplifier {
         double const settle_s = r.between(8.0, 40.0), jump = r.between(-0.5, 0.5), jump_s = r.between(10.0, 30.0);
         return [=](double x) { return creeping_zero_of(x, settle_s, jump, jump_s); };
       }},
      // the disc sits on the joint that turns; its error is small, so it shows on quick or heavy ones
      {"encoder_eccentricity",
       {"wrist", "shoulder", "elbow", "base"},
       2e-3,
       0.01,
       [](Random& r, JointDesign const&) -> Amplifier {
         double const phase = drawn_angle(r);
         return [=](double x) { return eccentric_disc_of(x, phase); };
       }},
  };
}

std::vector<DrawableEffect> joined(std::vector<std::vector<DrawableEffect>> const& groups) {
  std::vector<DrawableEffect> all;
  for (auto const& group : groups) all.insert(all.end(), group.begin(), group.end());
  return all;
}

}  // namespace

std::vector<DrawableEffect> const& catalogue_effects() {
  static std::vector<DrawableEffect> const all = joined({friction(), structure(), drive()});
  return all;
}

std::vector<DrawableEffect> const& outside_effects() {
  auto const& any = all_joint_names();
  static std::vector<DrawableEffect> const all = {
      {"outside_memory_drag", any, 0.3, 4.0,
       [](Random& r, JointDesign const&) -> Amplifier {
         double const build_s = r.between(0.3, 1.0), break_hz = r.between(3.0, 8.0), knee = r.between(0.03, 0.08);
         return [=](double x) { return memory_drag_of(x, build_s, break_hz, knee); };
       }},
      {"outside_sloshing", any, 0.05, 0.6,
       [](Random& r, JointDesign const&) -> Amplifier {
         double const frequency_hz = r.between(0.7, 1.8), limit = r.between(0.05, 0.2);
         return [=](double x) { return sloshing_of(x, frequency_hz, limit); };
       }},
      {"outside_hidden_shaft", any, 0.05, 0.6,
       [](Random& r, JointDesign const&) -> Amplifier {
         double const hz = r.between(1.0, 4.0), turns = r.between(0.5, 3.0);
         return [=](double x) { return hidden_shaft_of(x, hz, turns); };
       }},
      {"outside_supply_sag", any, 0.3, 3.0,
       [](Random& r, JointDesign const&) -> Amplifier {
         double const memory_s = r.between(0.3, 1.2);
         return [=](double x) { return supply_sag_of(x, memory_s); };
       }},
  };
  return all;
}

DrawableEffect const& drawable_effect(std::string const& name) {
  for (auto const* list : {&catalogue_effects(), &outside_effects()}) {
    for (auto const& effect : *list) {
      if (effect.name == name) return effect;
    }
  }
  throw std::invalid_argument("no effect named " + name);
}

}  // namespace concealed
