#pragma once
// Recordings of an arm less what the user's own simulator explains of them (METHOD.md, Comparison with a simulator).
//
// Equation   tau_sim = Y theta_sim + beyond, of all joints and training recordings at once, joints weighed by their own
//            noise; torque of a joint = tau - beyond. A joint that rests or turns: bridged (pipeline/simulator_gap.hpp)
// Load       `beyond` passes the gear all the same: Recording::gear_load
// Share      of the energy of tau - tau_sim at a joint, what other parameters of the model explain
// Shapes     as the recordings given
// Units      SI
// Errors     those of fit_parameters()
// Threads    free functions

#include <span>
#include <vector>

#include "engine/diagnose/arms/arm_fit.hpp"

namespace torquescope {

struct ArmWithoutSimulator {
  std::vector<RecordedArm> train{}, validate{};  // no simulated torque any more
  std::vector<double> parameter_share{};         // [N]
};

bool has_simulator(std::span<RecordedArm const> recordings);

// every joint of every recording has a simulated torque
ArmWithoutSimulator without_simulator(ArmModel const& model, std::span<RecordedArm const> train,
                                      std::span<RecordedArm const> validate, ArmFilter const& filter);

}  // namespace torquescope
