#pragma once
// Hidden effects under the names the engine should find them by, sized as shares of the joint they are put into.
//
// Names      those of engine/effects/README.md; "" for what that catalogue does not hold. catalogue_words.py holds
//            effects, families, parameters and units against what the engine says of itself
// Units      shares of the joint's Coulomb friction, peak speed, range or inertia, unless a unit is in the name

#include <functional>
#include <string>
#include <vector>

#include "concealed/effects/laws.hpp"
#include "concealed/instruments/faults.hpp"
#include "concealed/rig.hpp"

namespace concealed {

// a parameter whose meaning does not depend on the form of the law, so that an estimate can be held against it
struct TrueParameter {
  std::string name;
  double value = 0.0;
  std::string unit;  // for the joint's kind
};

struct ConcealedEffect {
  std::string name;
  std::vector<std::string> families;  // own one first, then those it is also confused with
  std::string form;                   // the law as simulated
  bool catalogue_form = false;        // the engine's catalogue has this very law
  Effect law;                         // none when a fault of the instruments is concealed
  std::vector<TrueParameter> parameters;
  Fault fault = nullptr;
};

// puts an effect into a joint
using EffectMaker = std::function<ConcealedEffect(JointDesign const&)>;

EffectMaker lorentzian_stribeck_of(double rise_of_coulomb, double speed_of_peak);
EffectMaker rational_stribeck_of(double rise_of_coulomb, double speed_of_peak);
EffectMaker presliding_of(double distance_of_range);
EffectMaker backlash_of(double load_of_inertia, double half_gap_of_range, double contact_hz, double film_per_s = 0.0);
EffectMaker cogging_of(double amplitude_of_coulomb, double order);
EffectMaker warm_up_of(double share, double fast_s, double slow_s);
EffectMaker asymmetric_viscous_of(double drag_of_viscous);
EffectMaker gravity_of(double torque_of_coulomb, double angle_rad);
EffectMaker spring_of(double torque_at_range_of_coulomb, double rest_of_range, double hardening);
EffectMaker load_friction_of(double share, double round_of_coulomb);
EffectMaker memory_drag_of(double drag_of_coulomb, double build_s, double break_at_peak_hz, double knee_of_peak);
EffectMaker sloshing_of(double load_of_inertia, double frequency_hz, double limit_of_range);

// concealed_friction.cpp
EffectMaker speed_drag_of(double torque_at_peak_of_coulomb);
EffectMaker shear_thinning_of(double torque_at_peak_of_coulomb, double knee_of_peak, double exponent);
EffectMaker lagging_friction_of(double rise_of_coulomb, double speed_of_peak, double thicken_s, double thin_s);
EffectMaker slip_elements_of(double share_of_coulomb, double distance_of_range);
EffectMaker resting_bond_of(double rise_of_coulomb, double onset_s, double distance_of_range);
EffectMaker tight_spots_of(double amplitude_of_coulomb, double waves_per_travel, double phase);
EffectMaker gear_losses_of(double driving, double driven_of_driving, double round_of_coulomb);
EffectMaker wandering_friction_of(double step_of_coulomb, std::uint64_t seed);

// concealed_structure.cpp
EffectMaker rope_of(double torque_at_range_of_coulomb, double rest_of_range, double rub_share,
                    double distance_of_range);
EffectMaker hard_stop_of(double torque_at_range_of_coulomb, double place_of_range);
EffectMaker gear_error_of(double amplitude_of_range, double order, double phase);
EffectMaker flexible_gear_of(double load_of_inertia, double frequency_hz, double damping);
EffectMaker push_of(double peak_of_coulomb, double start_s, double rise_s);
EffectMaker hum_of(double amplitude_of_coulomb, double frequency_hz, double phase);
EffectMaker picked_up_load_of(double load_of_inertia, double time_s);
EffectMaker hidden_shaft_of(double amplitude_of_coulomb, double hz, double turns_per_range);
EffectMaker supply_sag_of(double share_at_peak_power, double memory_s);

// concealed_drive.cpp; peak torque: to reach the peak speed in the time of the strokes, against friction and weight
double peak_torque(JointDesign const& joint);
EffectMaker torque_ripple_of(double share, double order, double phase);
EffectMaker saturation_of(double share_lost_at_peak);
EffectMaker current_loop_of(double late_s, double damping);
EffectMaker late_torque_of(double delay_s);
EffectMaker limited_torque_of(double lowest_of_peak, double highest_of_peak);
EffectMaker creeping_zero_of(double creep_of_coulomb, double settle_s, double jump_of_creep, double jump_s);
EffectMaker eccentric_disc_of(double error_rad, double phase);

}  // namespace concealed
