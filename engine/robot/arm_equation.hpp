#pragma once
// The equation of motion of an arm at one instant after the other: mass matrix by composite inertias, bias by one pass
// outwards and one inwards.
//
// Equation   M(q) ddq + bias(q, dq) = tau; drive inertias stand on M's diagonal; no friction
// Shapes     q, dq, bias: N; M: N x N, symmetric; parameters: 10 N or 11 N, standard, or base values in their columns
// Units      SI
// Bits       the same on every machine: sines by kernels/elementary.hpp
// Threads    one object, one thread; set() does not allocate
// Source     Walker and Orin 1982, doi:10.1115/1.3139699, method 3

#include <Eigen/Core>
#include <vector>

#include "engine/robot/inverse_dynamics.hpp"
#include "engine/robot/link_motion.hpp"

namespace torquescope {

class ArmEquation {
 public:
  ArmEquation(SerialChain const& chain, JointVector const& parameters);

  Eigen::Index size() const { return chain_.size(); }
  void set(JointVector const& q, JointVector const& dq);
  Eigen::MatrixXd const& mass() const { return mass_; }
  Eigen::VectorXd const& bias() const { return bias_; }

 private:
  void set_poses(JointVector const& q);
  void set_mass();
  void set_bias(JointVector const& dq);

  SerialChain chain_;
  std::vector<LinkInertia> links_;
  Eigen::MatrixXd drives_;
  Eigen::VectorXd still_;
  std::vector<double> cos_alpha_, sin_alpha_;
  // of the instant
  std::vector<double> angle_, cosine_, sine_;
  std::vector<LinkMotion> motion_;
  std::vector<LinkInertia> composite_;
  Eigen::MatrixXd mass_;
  Eigen::VectorXd bias_;
};

}  // namespace torquescope
