#pragma once
// The rows of an arm's least squares: which columns each joint's equation has, and their numbers.
//
// Equation   tau_j = sum over base parameters k with first_row <= j <= last_row of Phi_jk chi_k + friction of joint j
// Columns    of joint j: the base parameters that act on it in their order (links, then its drive inertia if that is a
//            base parameter), then viscous dq, Coulomb sign(dq) with sign(0) = 0, offset 1, as asked for. Not those of
//            drives that turn with several joints (SerialChain::is_coupled)
// Threads    immutable after the constructor
// Source     Gautier and Khalil 1990, doi:10.1109/70.56655 (the columns); kernels/arm_rows.hpp (how they are made)

#include <Eigen/Core>
#include <span>
#include <string>
#include <vector>

#include "engine/robot/base_parameters.hpp"
#include "kernels/arm_rows.hpp"

namespace torquescope {

// of one joint
struct FrictionColumns {
  bool viscous = true, coulomb = true, offset = true;
};

struct ArmColumn {
  static constexpr Eigen::Index of_the_joint = -1;

  std::string name;   // "xxr2", "drive_3", "viscous_3"
  Eigen::Index base;  // which base parameter, or of_the_joint
};

// of one joint, equally long; finite numbers, also where a weight is 0
struct JointSamples {
  std::span<double const> q, dq, ddq, tau;
  std::span<double const> root_weight{};  // empty: 1 everywhere; 0 leaves the row out, not the joint's motion
};

class ArmRows {
 public:
  // friction: one a joint
  ArmRows(SerialChain const& chain, BaseParameters const& base, std::span<FrictionColumns const> friction);

  Eigen::Index joints() const { return static_cast<Eigen::Index>(columns_.size()); }
  std::vector<ArmColumn> const& columns(Eigen::Index joint) const { return columns_[static_cast<std::size_t>(joint)]; }
  kernels::ArmPlan const& plan() const { return plan_; }

  // n_samples x (columns + 1), the torque last; each row times its root weight. samples: one a joint
  Eigen::MatrixXd rows(std::span<JointSamples const> samples, Eigen::Index joint) const;
  // of every joint in one sweep, without the torque: into the first columns(joint) columns of rows[joint], which has
  // n_samples rows
  void fill(std::span<JointSamples const> samples, std::span<Eigen::MatrixXd> rows) const;

 private:
  // take(block, first sample, count), block after block
  template <class Take>
  void for_each_block(std::span<JointSamples const> samples, Take const& take) const;
  void copy_columns(double const* block, Eigen::Index joint, std::size_t count, Eigen::Ref<Eigen::MatrixXd> out) const;

  std::vector<std::vector<ArmColumn>> columns_;
  kernels::ArmPlan plan_;
};

// what the kernels read. Requires as many samples in every channel of every joint
std::vector<kernels::JointSignals> signals_of(std::span<JointSamples const> samples);

}  // namespace torquescope
