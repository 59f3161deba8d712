#pragma once
// computeJointTorqueRegressor of Pinocchio for an arm of revolute and prismatic joints about z.
//
// Columns    of a link: m, first moments, xx xy yy xz yz zz; ours have xz before yy, and place() finds them

#include <pinocchio/algorithm/regressor.hpp>

#include <string>

#include "bench/arms/plain_regressor.hpp"

namespace peers {

class PinocchioRegressor {
 public:
  explicit PinocchioRegressor(Arm const& arm) : model_(model_of(arm)), data_(model_) {}

  static Eigen::Index place(Eigen::Index column) {
    return column % 10 == 6 ? column + 1 : column % 10 == 7 ? column - 1 : column;
  }
  template <class Vector>
  Eigen::MatrixXd const& operator()(Vector const& q, Vector const& dq, Vector const& ddq) {
    return pinocchio::computeJointTorqueRegressor(model_, data_, q, dq, ddq);
  }

 private:
  static pinocchio::Model model_of(Arm const& arm) {
    pinocchio::Model model;
    model.gravity.linear() = arm.gravity;
    pinocchio::JointIndex parent = 0;
    for (auto const& joint : arm.joints) {
      double const ca = std::cos(joint.alpha), sa = std::sin(joint.alpha);
      double const ct = std::cos(joint.offset), st = std::sin(joint.offset);
      Eigen::Matrix3d rotation;
      rotation << ct, -st, 0.0, ca * st, ca * ct, -sa, sa * st, sa * ct, ca;
      pinocchio::SE3 const placement(rotation, Eigen::Vector3d(joint.a, -sa * joint.d, ca * joint.d));
      std::string const name = "joint_" + std::to_string(parent + 1);
      parent = joint.slides != 0 ? model.addJoint(parent, pinocchio::JointModelPZ(), placement, name)
                                 : model.addJoint(parent, pinocchio::JointModelRZ(), placement, name);
      model.appendBodyToJoint(parent, pinocchio::Inertia::Identity());
    }
    return model;
  }

  pinocchio::Model model_;
  pinocchio::Data data_;
};

}  // namespace peers
