#pragma once
// The rows of an arm's joints, told apart: what the rigid arm needs at its fitted parameters, and what is left to the
// equation of motion of each joint alone while the others move as recorded.
//
// Equation   tau_j = y_j(q, dq, ddq) chi + friction_j + what is missing; y_j chi = J_j ddq_j + beside_j,
//            J_j the mean of M_jj(q) over the recordings. Of joint j alone: tau_j - beside_j
// Load       beside_j passes the gear: Recording::gear_load
// Fit        all joints of all training recordings together, rows divided by the noise of their joint (WLS; Gautier
//            1997, doi:10.1109/ROBOT.1997.606794), where a joint moves one way
//            Where rows cannot tell all parameters apart: the least-norm solution (shortest_fit.hpp)
// Accuracy   errors of the fitted parameters go with every recording as Recording::load_errors, those above a tenth of
//            the joint's noise; what a joint may correct (rigid_corrections.hpp) as a law of Recording::given
// Laws       of several joints: their columns go with every recording as Recording::given (arm_laws.hpp)
// Units      SI
// Errors     those of the filters
// Threads    free functions

#include <Eigen/Core>
#include <optional>
#include <span>
#include <vector>

#include "engine/diagnose/arms/filtered_arm.hpp"
#include "engine/diagnose/arms/rigid_corrections.hpp"
#include "engine/fit/problem/arm_model.hpp"
#include "engine/fit/problem/recorded_arm.hpp"

namespace torquescope {

struct FittedArm {
  Eigen::VectorXd parameters;    // [R] of the model
  Eigen::MatrixXd errors;        // [R][r] independent errors of the parameters, each of one standard deviation (HAC)
  Eigen::MatrixXd white_errors;  // the same if residuals were white: by the rows that tell a parameter alone
  Eigen::VectorXd inertia;       // [N] J_j
  Eigen::VectorXd noise;         // [N] standard deviation of what is left of each joint
  std::vector<RigidCorrections> corrections{};  // [N]
};

FittedArm fit_arm(ArmModel const& model, std::span<RecordedArm const> recordings, ArmFilter const& filter);

// of a joint: the energy of its torque, and what the fitted parameters leave of it, on the rows of the fit
struct JointEnergies {
  double torque = 0.0, left = 0.0;
};

// the same fit without its errors
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

// each joint of a recording, also of one that nothing was fitted to, as a recording of its own
std::vector<Recording> joints_alone(ArmModel const& model, FittedArm const& fitted, RecordedArm const& recording,
                                    ArmFilter const& filter);

// number of kept samples at which this joint surely moves one way
Eigen::Index rows_one_way(Recording const& joint, ArmFilter const& filter);

}  // namespace torquescope
