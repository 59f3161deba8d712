#pragma once
// One fit of an arm to recordings: base parameters and frictions of all joints together.
//
// Fit        rows where a joint moves one way, divided by the noise of their joint (WLS; Gautier 1997,
//            doi:10.1109/ROBOT.1997.606794). Where rows cannot tell all parameters apart: the least-norm solution
//            (shortest_fit.hpp)
// Shapes     R parameters of the model, N joints
// Units      SI
// Errors     those of the filters
// Threads    free functions

#include <Eigen/Core>
#include <optional>
#include <span>
#include <vector>

#include "engine/diagnose/arms/filtered_arm.hpp"
#include "engine/fit/problem/arm_model.hpp"
#include "engine/fit/problem/recorded_arm.hpp"

namespace torquescope {

// of a joint: the energy of its torque, and what the fitted parameters leave of it, on the rows of the fit
struct JointEnergies {
  double torque = 0.0, left = 0.0;
};

struct PlainArmFit {
  Eigen::VectorXd parameters{}, noise{};  // [R], [N]
  std::vector<JointEnergies> energies{};  // [N]
};

// deviation: [N], of the weights; none: the noise of the recordings
PlainArmFit fit_parameters(ArmModel const& model, std::span<RecordedArm const> recordings, ArmFilter const& filter,
                           std::optional<Eigen::VectorXd> const& deviation = {});

// of each joint, n samples at the full rate: what an arm of these parameters, with frictions and payload, needs
std::vector<Eigen::VectorXd> needed_torques(ArmModel const& model, Eigen::VectorXd const& parameters,
                                            RecordedArm const& recording, ArmFilter const& filter);

}  // namespace torquescope
