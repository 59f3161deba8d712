#pragma once
// How the columns of an arm's recording are taken: which is whose, with what sign, zero and unit, about which chain.
//
// Equation   q_j = position_factor_j * column[position_of_j] + zero_j; tau_j = torque_factor_j * column[torque_of_j]
// Shapes     [n][N]: samples, joints from the base to the tip
// Units      SI as the job reads the columns
// Threads    plain records, pure functions

#include <Eigen/Core>
#include <string>
#include <vector>

#include "engine/data/motion.hpp"
#include "engine/fit/problem/recorded_arm.hpp"
#include "engine/robot/serial_chain.hpp"

namespace torquescope {

struct ArmSamples {
  Eigen::MatrixXd q, dq, ddq, tau;
  Eigen::MatrixXd moves;             // 1 where the joint moves, else 0
  Eigen::VectorXd time_s;            // on each recording's own clock
  std::vector<Eigen::Index> begins;  // first row of each recording
  // what a wrench at the tip adds to tau, and what it would add in its other frame; empty: there is none
  Eigen::MatrixXd outside, outside_otherwise;

  Eigen::Index size() const { return q.rows(); }
  // of one recording: at most `most` samples, evenly, without `edge` samples at each end that a filter spoils
  void add(std::vector<Motion> const& motion, std::vector<std::vector<bool>> const& moving, Eigen::Index edge,
           Eigen::Index most, OutsideTorques const& outside_torques = {});
};

enum class SetupKind {
  joint_sign,  // position and torque count the other way round
  torque_sign,
  position_sign,
  joints_exchanged,  // positions and torques of two joints
  positions_exchanged,
  torques_exchanged,
  dh_convention,    // numbers of the robot file are of the convention that it does not name
  gravity,          // `number`: angle by which it is turned about axis `joint` of the file's base frame
  no_gravity,       // the torque has none: a driver took it away
  motor_side,       // torques of all joints stand before the gears of the robot file
  position_factor,  // of one joint, or of all (joint -1)
  torque_factor,    // the same
  zero              // `number`: rad added to the position
};

struct SetupChange {
  SetupKind kind = SetupKind::joint_sign;
  Eigen::Index joint = -1, other = -1;
  double number = 1.0;
};

struct ArmSetup {
  SerialChain chain{};
  std::vector<Eigen::Index> position_of{}, torque_of{};
  Eigen::VectorXd position_factor{}, torque_factor{}, zero{};
  bool is_of_other_convention = false;
};

ArmSetup setup_as_read(SerialChain const& chain);
// otherwise: the same robot in the other convention, for dh_convention
ArmSetup changed(ArmSetup setup, SetupChange const& change, SerialChain otherwise = {});
ArmSamples taken_as(ArmSamples const& samples, ArmSetup const& setup);

}  // namespace torquescope
