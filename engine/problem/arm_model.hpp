#pragma once
// The model of an arm as linear parameters: the base parameters of its links and drives, then the friction of each
// joint.
//
// Equation   tau_j = y_j(q, dq, ddq) chi + f_j(q_j, dq_j, ddq_j) phi_j; row j has the links from j on, its own drive
//            and its own friction
// Order      base parameters as robot/base_parameters.hpp has them; friction of joint 1, of joint 2, ...; names end in
//            the joint's number: "viscous_3"
// Shapes     N joints, R parameters, n samples
// Errors     Error 78 as Regressor(), of the effects that each joint has beside the rigid arm
// Threads    immutable
// Source     Khalil and Dombre 2002, Modeling, Identification and Control of Robots, chapter 12

#include <Eigen/Core>
#include <string>
#include <vector>

#include "engine/data/motion.hpp"
#include "engine/effects/regressor.hpp"
#include "engine/robot/arm_rows.hpp"
#include "engine/robot/base_parameters.hpp"
#include "engine/robot/serial_chain.hpp"

namespace torquescope {

struct ArmTerms {
  std::vector<std::string> friction{};
  DriveInertias drives = DriveInertias::included;
  double velocity_deadband = 0.0;
};

class ArmModel {
 public:
  // `model`: the job's [model] section, for the places in messages
  ArmModel(SerialChain chain, ArmTerms const& terms, Section const& model);

  SerialChain const& chain() const { return chain_; }
  BaseParameters const& base() const { return base_; }
  DriveInertias drives() const { return drives_; }
  std::size_t joints() const { return chain_.joints.size(); }
  std::size_t size() const { return columns_.size(); }
  std::vector<RegressorColumn> const& columns() const { return columns_; }
  std::vector<std::string> names() const;
  std::vector<std::string> units() const;
  std::vector<std::string> joint_names() const;      // of the robot file; "" where it has none
  std::string torque_unit(std::size_t joint) const;  // "N m", or "N" of a slide
  std::string equation() const;                      // "tau = Phi(q, dq, ddq) chi + Fv dq + ..."
  // +1 or -1 where what exists has that sign: frictions (which take work out of a joint) and drive inertias that stand
  // alone; 0 elsewhere
  Eigen::VectorXd passive_signs() const;
  // parameters that row `joint` depends on, ascending
  std::vector<Eigen::Index> const& parameters_of(std::size_t joint) const { return own_[joint]; }

  // of each joint the columns of its own parameters, n x parameters_of(joint); one motion a joint, equal lengths
  std::vector<Eigen::MatrixXd> rows(std::vector<Motion> const& motion) const;

 private:
  void fill_rigid(std::vector<Motion> const& motion, std::vector<Eigen::MatrixXd>& rows) const;

  SerialChain chain_;
  DriveInertias drives_;
  BaseParameters base_;
  ArmRows rigid_;
  std::vector<Regressor> friction_;  // one a joint, or none
  std::vector<RegressorColumn> columns_;
  std::vector<std::vector<Eigen::Index>> own_;
};

}  // namespace torquescope
