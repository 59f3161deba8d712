#pragma once
// A serial arm: joints in modified Denavit-Hartenberg frames, limits, drives, inertias where they are known.
//
// Equation   T(i-1, i) = Rx(alpha_i) Tx(a_i) Rz(theta_i) Tz(d_i)
//            revolute   theta_i = q_i + offset_i, d_i constant; prismatic   theta_i = offset_i, d_i = d_i + q_i
//            motors     turn by T q on the joint side; what they need is felt at the joints as T' of it
// Frames     z_i is the axis of joint i; link i is fixed in frame i; frame 0 is the base. Joints count from 0 in code
//            and from 1 in names and texts
// Units      SI; the generalised force is N m, or N at a prismatic joint
// Threads    values
// Source     Khalil and Dombre 2002, Modeling, Identification and Control of Robots, section 3.2; Craig 1986

#include <Eigen/Core>
#include <limits>
#include <string>
#include <vector>

#include "engine/robot/joint_kind.hpp"
#include "engine/robot/link_inertia.hpp"

namespace torquescope {

struct ChainJoint {
  static constexpr double no_limit = std::numeric_limits<double>::infinity();

  std::string name{};
  JointKind kind = JointKind::revolute;
  double a = 0.0;                              // m
  double alpha = 0.0;                          // rad
  double d = 0.0;                              // m
  double offset = 0.0;                         // rad
  double lower = -no_limit, upper = no_limit;  // rad or m
  double max_speed = no_limit;                 // rad/s or m/s
  double max_acceleration = no_limit;          // rad/s^2 or m/s^2
  double max_torque = no_limit;                // N m or N
  double gear_ratio = 1.0;                     // motor turns per joint turn
  double drive_inertia = 0.0;                  // kg m^2 or kg on the joint side: rotor x gear_ratio^2; 0: unknown
  double encoder_step = 0.0;                   // rad or m on the joint side; 0: unknown
};

struct SerialChain {
  std::string name{};
  std::vector<ChainJoint> joints{};
  std::vector<LinkInertia> links{};          // one a joint, or none: inertias unknown
  Eigen::Vector3d gravity{0.0, 0.0, -9.81};  // m/s^2 in frame 0
  FramePose base{};                          // frame 0 seen from the file's base frame
  FramePose flange{};                        // the tool's frame seen from the last link's
  Eigen::MatrixXd transmission{};            // T, N x N; empty: every motor turns its own joint alone
  std::vector<std::string> remarks{};        // sentences: what the reader did on its own
  std::vector<std::string> warnings{};       // the same of what may be wrong, with file and line

  Eigen::Index size() const { return static_cast<Eigen::Index>(joints.size()); }
  bool has_inertias() const { return !links.empty(); }
  bool has_coupled_drives() const { return transmission.size() > 0; }
  // whether motor i turns with another joint than its own
  bool is_coupled(Eigen::Index motor) const {
    return has_coupled_drives() && (transmission.row(motor).array() != 0.0).count() > 1;
  }
  // torque on the joints, of drives with these inertias: T' diag(inertias) T
  Eigen::MatrixXd drive_matrix(Eigen::Ref<Eigen::VectorXd const> const& inertias) const;
};

// frame i seen from frame i - 1 with joint i at q
FramePose joint_pose(ChainJoint const& joint, double q);

struct CosineSine {
  double cosine, sine;
};
// the same from numbers at hand
FramePose dh_pose(CosineSine alpha, CosineSine theta, double a, double d);

// whether joint-side rotor inertias are parameters of their own: N more columns behind the 10 N of the links
enum class DriveInertias { left_out, included };

// 10 N (+ N) numbers: the links', then the drive inertias. Requires has_inertias()
Eigen::VectorXd standard_parameters(SerialChain const& chain, DriveInertias drives);

// "xx2", "drive_3": names of the standard parameters in their order
std::vector<std::string> standard_names(SerialChain const& chain, DriveInertias drives);

}  // namespace torquescope
