#pragma once
// Rows of a serial arm's regressor, samples side by side: one row a joint and sample, only the columns that stand.
//
// Equation   column c of link k in row j: u.N_c + v.F_c; force F_c and moment N_c that moves link k per unit of its
//            parameter c; (u, v) the screw of joint j seen in frame k, carried outwards from joint j. No Phi in memory
// Order      columns of links j, j + 1, ... in the order m, mx, my, mz, xx, xy, xz, yy, yz, zz; the joint's own
//            columns in the order of OwnColumn; last the torque. Every number is multiplied by root_weight
// Shapes     rows: joint after joint, [group of 8 samples][column][8]; places behind the last sample are zero
// Units      SI; frames and joints as in engine/robot/serial_chain.hpp (modified Denavit-Hartenberg)
// Bits       the same on every instruction set, and wherever in a block a sample stands
// Threads    a plan is immutable; calls each with their own workspace; arm_rows does not allocate
// Source     Khalil and Dombre 2002, Modeling, Identification and Control of Robots, sections 9.5 and 12.3

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "kernels/lane_sum.hpp"

namespace torquescope::kernels {

// samples that one call turns into rows at most: the rows of six joints take 190 KB and stay in L2
inline constexpr std::size_t row_block_samples = 128;

enum class JointMotion : std::uint8_t { turns, slides };

// bits of ArmJoint::own_columns: ddq, dq, sign(dq) with sign(0) = 0, and 1
enum OwnColumn : std::uint8_t { own_acceleration = 1, own_speed = 2, own_direction = 4, own_one = 8 };

struct ArmJoint {
  double a = 0.0, d = 0.0;                  // m
  double cos_alpha = 1.0, sin_alpha = 0.0;  // of the twist
  double offset = 0.0;                      // rad
  JointMotion motion = JointMotion::turns;
  std::uint16_t link_columns = 0;  // bit c: column c of this joint's link stands
  std::uint8_t own_columns = 0;    // bits of OwnColumn
};

class ArmPlan {
 public:
  // gravity: m/s^2 in frame 0
  ArmPlan(std::vector<ArmJoint> joints, std::array<double, 3> const& gravity);

  std::vector<ArmJoint> const& joints() const { return joints_; }
  std::array<double, 3> const& gravity() const { return gravity_; }
  std::size_t size() const { return joints_.size(); }
  // columns that stand of the links before `link`, which may be size()
  std::size_t columns_before(std::size_t link) const { return columns_before_[link]; }
  // numbers in a row of `joint`: its columns and the torque
  std::size_t row_width(std::size_t joint) const { return row_width_[joint]; }
  // doubles of a block before the rows of `joint`, which may be size(): the doubles of a block
  std::size_t rows_before(std::size_t joint) const { return rows_before_[joint]; }

 private:
  std::vector<ArmJoint> joints_;
  std::array<double, 3> gravity_;
  std::vector<std::size_t> columns_before_, row_width_, rows_before_;
};

// of one joint; finite numbers, also where the weight is 0; |angle| as in cosine_sine_of_multiple()
struct JointSignals {
  double const* q = nullptr;
  double const* dq = nullptr;
  double const* ddq = nullptr;
  double const* tau = nullptr;
  double const* root_weight = nullptr;  // null: 1 everywhere; 0 leaves the sample's row out
};

std::size_t arm_rows_workspace_size(ArmPlan const& plan);

// samples first .. first + count, count <= row_block_samples; signals: one a joint.
// Writes rows_before(size()) doubles at most: groups of 8 that hold no sample are left as they are
void arm_rows(ArmPlan const& plan, JointSignals const* signals, std::size_t first, std::size_t count, double* rows,
              double* workspace);

// asks for samples first .. first + count: many short streams, which the hardware does not foresee. Ask joint by joint
// between other work: more than some 60 lines at once wait for each other
void prefetch_samples(JointSignals const& signals, std::size_t first, std::size_t count);

// groups of 8 samples
constexpr std::size_t group_count(std::size_t n_samples) { return (n_samples + n_lanes - 1) / n_lanes; }

}  // namespace torquescope::kernels
