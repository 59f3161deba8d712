// Single concealed effects: transmission, drive, instruments, outside.
#include "stranger/cases.hpp"

namespace stranger {
std::vector<Case> structure_cases() {
  std::vector<Case> cases;
  // 22 slots per turn
  cases.push_back(single("cogging", "direct", "creep", "mixed", 30, {"", "tabulated", {0.006, 3.5014, 0.2}}));
  cases.push_back(single("transmission_error", "gear", "mixed", "trapezoids", 45, {"", "wavy_gear", {0.01, 14}}));
  cases.push_back(single("joint_elasticity", "pan", "chirp", "multisine", 30, {"", "soft_shaft", {13, 0.04}}));
  cases.push_back(single("backlash", "gear", "trapezoids", "mixed", 40, {"", "damped_gap", {0.003, 25, 0.1}}));
  cases.back().acceptable = {"presliding"};
  cases.push_back(single("delay", "belt", "trapezoids", "mixed", 30, {"", "late_torque", {0.0031}}));
  cases.back().acceptable = {"actuator_lag"};
  cases.push_back(
      single("actuator_lag", "direct", "multisine", "trapezoids", 25, {"", "second_order_current", {0.0018, 0.6}}));
  cases.back().instruments.white = 0.03, cases.back().instruments.coloured = 0.02;
  cases.back().acceptable = {"delay"};
  cases.push_back(single("torque_constant", "arm", "trapezoids", "irregular", 30, {"", "saturated_iron", {18}}));
  cases.push_back(single("payload_change", "arm", "irregular", "trapezoids", 45, {"", "gripped_load", {0.04, 21, 1.1}},
                         {"time", 21, 45}));
  cases.push_back(
      single("contact", "pan", "multisine", "irregular", 30, {"", "leaning", {0.04, 11.4, 0.9}}, {"time", 11.4, 12.3}));
  cases.push_back(
      single("periodic_disturbance", "servo", "mixed", "irregular", 50, {"", "press_next_door", {0.002, 3.3}}));
  return cases;
}

}  // namespace stranger
