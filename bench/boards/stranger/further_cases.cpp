// Pairs of effects, physics that no catalogue has, and motion that says too little.
#include "stranger/cases.hpp"

namespace stranger {
namespace {

Case further(std::string name, std::string kind, std::string rig, std::string train, std::string validation,
             double train_s, std::vector<ConcealedLaw> laws, std::vector<std::string> acceptable = {}) {
  Case c = usual(std::move(name), std::move(kind), std::move(rig));
  c.train_motion = std::move(train), c.validation_motion = std::move(validation);
  c.train_s = train_s, c.validation_s = train_s * 0.7;
  c.laws = std::move(laws), c.acceptable = std::move(acceptable);
  return c;
}

}  // namespace

std::vector<Case> further_cases() {
  std::vector<Case> cases;
  cases.push_back(further("pair_stribeck_spring", "pair", "pan", "creep", "mixed", 40,
                          {{"stribeck", "lorentz", {0.016, 0.08}}, {"spring", "rational_spring", {0.006, 0.3, 2.4}}}));
  cases.push_back(
      further("pair_asymmetric_cogging", "pair", "belt", "mixed", "trapezoids", 40,
              {{"asymmetric_viscous", "rounded_v", {3.5, 0.05}}, {"cogging", "tabulated", {1.1, 31.25, 0.4}}}));
  cases.push_back(
      further("pair_ripple_creeping_zero", "pair", "arm", "mixed", "irregular", 50,
              {{"torque_ripple", "wavy_motor", {0.03, 11}}, {"sensor_drift", "creeping_zero", {0.15, 14}}}));
  cases.push_back(further("pair_elasticity_drag", "pair", "pan", "chirp", "trapezoids", 35,
                          {{"joint_elasticity", "soft_shaft", {13, 0.05}}, {"speed_drag", "windage", {0.008, 2.0}}}));
  cases.push_back(further("pair_disc_press", "pair", "direct", "multisine", "irregular", 25,
                          {{"encoder_eccentricity", "off_centre_disc", {0.0035, 0.9}},
                           {"periodic_disturbance", "press_next_door", {0.01, 4.7}}}));

  cases.push_back(further("outside_rotor_run_up", "outside", "direct", "irregular", "multisine", 34,
                          {{"outside", "rotor_run_up", {0.015, 1.5, 11}}}));
  cases.push_back(further("outside_dropping_channel", "outside", "pan", "multisine", "trapezoids", 30,
                          {{"outside", "dropping_channel", {0.25, 0.8}}}));
  cases.push_back(further("outside_flash_heat", "outside", "gear", "trapezoids", "mixed", 50,
                          {{"outside", "flash_heat", {0.15, 2.5}}}, {"thermal_friction"}));
  cases.push_back(further("outside_floating_base", "outside", "arm", "mixed", "irregular", 40,
                          {{"outside", "floating_base", {0.012}}}));
  cases.push_back(further("outside_eddy_brake", "outside", "belt", "trapezoids", "pick_place", 35,
                          {{"outside", "eddy_brake", {6, 0.45, 0.03}}}, {"position_dependent_friction"}));

  // one speed each way: a law of the speed and the Coulomb level are the same thing
  cases.push_back(further("weak_one_speed", "weak", "belt", "one_speed", "mixed", 30,
                          {{"stribeck", "lorentz", {2.5, 0.04}}}, {"stribeck"}));
  // a spring on a tenth of the travel: a weight looks the same
  cases.push_back(further("weak_narrow", "weak", "pan", "narrow", "multisine", 30,
                          {{"spring", "rational_spring", {0.04, 0.1, 2.6}}}, {"spring", "gravity", "cable"}));
  return cases;
}

}  // namespace stranger
