#pragma once
// Hidden effects under the names the engine should find them by, sized as shares of the joint they are put into.
//
// Names      PHYSICS.md section 1; "" for what that catalogue does not hold. catalogue_words.py holds effects, families,
//            parameters and units against what the engine says of itself
// Units      shares of the joint's Coulomb friction, peak speed, range or inertia, unless a unit is in the name

#include <functional>
#include <string>
#include <vector>

#include "concealed/effects/laws.hpp"
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
  Effect law;
  std::vector<TrueParameter> parameters;
};

// puts an effect into a joint
using EffectMaker = std::function<ConcealedEffect(JointDesign const&)>;

EffectMaker lorentzian_stribeck_of(double rise_of_coulomb, double speed_of_peak);
EffectMaker rational_stribeck_of(double rise_of_coulomb, double speed_of_peak);
EffectMaker presliding_of(double distance_of_range);
EffectMaker backlash_of(double load_of_inertia, double half_gap_of_range, double contact_hz);
EffectMaker cogging_of(double amplitude_of_coulomb, double order);
EffectMaker warm_up_of(double share, double fast_s, double slow_s);
EffectMaker asymmetric_viscous_of(double drag_of_viscous);
EffectMaker gravity_of(double torque_of_coulomb, double angle_rad);
EffectMaker spring_of(double torque_at_range_of_coulomb, double rest_of_range, double hardening);
EffectMaker load_friction_of(double share, double round_of_coulomb);
EffectMaker memory_drag_of(double drag_of_coulomb, double build_s, double break_at_peak_hz, double knee_of_peak);
EffectMaker sloshing_of(double load_of_inertia, double frequency_hz, double limit_of_range);

}  // namespace concealed
