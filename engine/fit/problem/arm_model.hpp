#pragma once
// The model of an arm as linear parameters: the base parameters of its links and drives, the friction of each joint,
// effects at held shapes, what is not known of its payloads, the errors of its drive gains.
//
// Equation   (1 + g_j) tau_j = y_j(q, dq, ddq) (chi + payload) + f_j(q_j, dq_j, ddq_j) phi_j; row j has the links from
//            j on, its own drive and its own friction; the column of g_j is - tau_j. Drives that turn with several
//            joints (SerialChain::transmission): motor m has f_m and its inertia at T_m q, and row j feels T_mj of it
// Order      base parameters (robot/base_parameters.hpp); friction of joint 1, 2: "viscous_3"; effects: "stribeck_2";
//            unknown numbers of each payload (robot/payload.hpp): "payload1_mx6"; "gain_error_3"
// Shapes     N joints, R parameters, n samples
// Errors     Error 78 as Regressor(), of the effects that each joint has beside the rigid arm
// Threads    immutable
// Source     Khalil and Dombre 2002, Modeling, Identification and Control of Robots, chapter 12

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "engine/data/motion.hpp"
#include "engine/effects/regressor.hpp"
#include "engine/robot/arm_rows.hpp"
#include "engine/robot/base_parameters.hpp"
#include "engine/robot/payload.hpp"
#include "engine/robot/serial_chain.hpp"

namespace torquescope {

// an effect of one joint whose shape is held: its torque is linear in what is left
struct HeldEffect {
  Effect const* effect = nullptr;
  std::size_t joint = 0;
  std::vector<double> shape{};  // n_shape(); empty: not yet known
  JointScales scales{};         // of the joint's motion
  // base parameters and friction, at which what the gear carries is taken; empty: nothing
  Eigen::VectorXd baseline{};
};

struct ArmTerms {
  std::vector<std::string> friction{};                     // of every joint
  std::vector<std::vector<std::string>> joint_friction{};  // [N] of each, in place of it; empty: all are alike
  std::vector<Section> joint_sections{};                   // [N] of the job, where each one's stands; empty: [model]
  DriveInertias drives = DriveInertias::included;
  double velocity_deadband = 0.0;
  std::vector<Payload> payloads{};
  bool drive_gains = false;
  std::vector<HeldEffect> effects{};
};

class ArmModel {
 public:
  // `model`: the job's [model] section, for the places in messages
  ArmModel(SerialChain chain, ArmTerms const& terms, Section const& model);

  SerialChain const& chain() const { return chain_; }
  BaseParameters const& base() const { return base_; }
  DriveInertias drives() const { return terms_.drives; }
  // of each joint, where it has any
  std::vector<std::optional<Regressor>> const& friction() const { return friction_; }
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

  // motors that row `joint` feels: its own, and those that turn with it
  std::vector<std::size_t> motors_of_joint(std::size_t joint) const;
  // of the motor, on the joint's side; other channels are those of its own joint
  Motion motor_motion(std::vector<Motion> const& motion, std::size_t motor) const;
  // columns of friction in row `joint` that follow from its own motion: none where it feels or shares a coupled drive
  std::size_t friction_alone(std::size_t joint) const;

  // [N] of the errors of the gains; empty where gains are no parameters
  std::vector<Eigen::Index> const& gain_columns() const { return gains_; }
  std::vector<PayloadColumns> const& payloads() const { return payloads_; }
  std::vector<HeldEffect> const& effects() const { return terms_.effects; }
  // the same arm with these effects in place of its own
  ArmModel with_effects(std::vector<HeldEffect> effects) const;
  // [N] n x n_linear of an effect as joints feel it, empty where none does, zero of an unknown shape; rows: as rows()
  std::vector<Eigen::MatrixXd> effect_columns(HeldEffect const& held, std::vector<Motion> const& motion,
                                              std::vector<Eigen::MatrixXd> const& rows) const;

  // of each joint the columns of its own parameters, n x parameters_of(joint); one motion a joint, equal lengths, with
  // torques if gains are parameters. payload: which one the arm carries
  std::vector<Eigen::MatrixXd> rows(std::vector<Motion> const& motion, std::optional<std::size_t> payload = {}) const;
  // [n] of one joint: what is known of a payload, from the joint's rows
  Eigen::VectorXd known_torque(std::size_t joint, Eigen::MatrixXd const& rows, std::size_t payload) const;

 private:
  void add_effect_columns();
  void add_payload_columns();
  void add_gain_columns();
  void fill_rigid(std::vector<Motion> const& motion, std::vector<Eigen::MatrixXd>& rows) const;
  void fill_coupled_drives(std::vector<Motion> const& motion, std::vector<Eigen::MatrixXd>& rows) const;
  double turns(std::size_t motor, std::size_t joint) const;  // of the motor per turn of the joint
  std::vector<std::size_t> joints_of_motor(std::size_t motor) const;
  // base parameters of a joint's rows: its first columns
  std::vector<Eigen::Index> rigid_parameters(std::size_t joint) const;

  SerialChain chain_;
  ArmTerms terms_;
  BaseParameters base_;
  ArmRows rigid_;
  std::vector<std::optional<Regressor>> friction_;
  std::vector<PayloadColumns> payloads_;
  std::vector<Eigen::Index> gains_;
  Eigen::Index first_effect_ = 0;  // of the columns: base parameters and friction stand before it
  std::vector<RegressorColumn> columns_;
  std::vector<std::vector<Eigen::Index>> own_;
};

}  // namespace torquescope
