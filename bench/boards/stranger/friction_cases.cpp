// Single concealed effects: friction, and torques that belong to the place.
#include "stranger/cases.hpp"

namespace stranger {
std::vector<Case> friction_cases() {
  std::vector<Case> cases;
  cases.push_back(
      single("stribeck", "belt", "creep", "mixed", 40, {"", "lorentz", {1.6, 0.03}}, {"velocity", -0.06, 0.06}));
  cases.push_back(single("speed_drag", "pan", "trapezoids", "multisine", 30, {"", "windage", {0.006, 1.5}}));
  cases.back().instruments.position = PositionWord::degrees;
  cases.push_back(single("power_law_viscous", "gear", "mixed", "trapezoids", 45, {"", "eyring", {0.9, 0.03}}));
  cases.push_back(single("presliding", "arm", "micro", "mixed", 40, {"", "bristles", {0.002, 0.004}}));
  cases.push_back(single("maxwell_slip", "belt", "micro", "mixed", 45, {"", "slip_elements", {0.0015, 8}}));
  cases.push_back(
      single("breakaway_dwell", "gear", "pick_place", "irregular", 50, {"", "log_ageing", {6, 0.05, 0.01}}));
  cases.back().acceptable = {"stribeck"};
  cases.push_back(single("position_dependent_friction", "belt", "trapezoids", "pick_place", 30,
                         {"", "tight_spot", {1.5, 0.5, 0.07}}, {"position", 0.42, 0.58}));
  cases.back().instruments.torque = TorqueWord::amperes;
  cases.push_back(single("load_dependent_friction", "arm", "mixed", "irregular", 40, {"", "pressed_bearing", {0.03}}));
  cases.push_back(single("directional_efficiency", "arm", "trapezoids", "mixed", 40, {"", "worm_flank", {0.06, 0.25}}));
  cases.back().acceptable = {"load_dependent_friction"};
  cases.push_back(single("thermal_friction", "gear", "trapezoids", "mixed", 60, {"", "two_time_warm_up", {0.05, 9, 70}},
                         {"time", 0, 20}));
  cases.push_back(single("friction_drift", "belt", "pick_place", "trapezoids", 45, {"", "loose_screw", {1.5, 19, 2.5}},
                         {"time", 19, 45}));
  cases.back().acceptable = {"thermal_friction"};
  cases.push_back(single("gravity", "pan", "irregular", "multisine", 30, {"", "oblique_axis", {0.008, 0.7}}));
  cases.push_back(single("cable", "pan", "mixed", "trapezoids", 40, {"", "bouc_wen_hose", {0.004, 0.25, 0.6, 0.25}}));
  cases.back().acceptable = {"spring", "gravity"};
  cases.push_back(single("end_stop", "servo", "pick_place", "multisine", 40, {"", "hunt_crossley", {0.06, 2.75, 0.15}},
                         {"position", 2.75, 3.2}));
  cases.back().instruments.position = PositionWord::counts;
  return cases;
}

}  // namespace stranger
