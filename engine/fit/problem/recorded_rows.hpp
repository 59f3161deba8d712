#pragma once
// One recording of an arm as rows of every joint, after the parallel filter: columns of the joint's own parameters.
//
// Rows       those where the joint moves one way, and the others: near a reversal friction changes its sign within the
//            filter's memory. Neither has instants at which the torque of the joint, or the motion of one that it feels
//            (joint_dependence.hpp), is left out
// Shapes     columns: n x ArmModel::parameters_of(joint); instant: index of the kept sample, equal in all joints
// Units      N m or N; s; rad or m
// Errors     as differentiate() and ParallelFilter
// Threads    free function

#include <Eigen/Core>
#include <string>
#include <vector>

#include "engine/data/row_account.hpp"
#include "engine/fit/problem/arm_model.hpp"

namespace torquescope {

struct JointRows {
  Eigen::MatrixXd columns;
  Eigen::VectorXd torque, time_s, q, dq, ddq;
  std::vector<Eigen::Index> instant;
};

struct RecordedRows {
  std::string recording;
  double rate_hz = 0.0, kept_rate_hz = 0.0;
  Eigen::Index instants = 0;              // kept samples
  std::vector<JointRows> moving, others;  // [N]
  std::vector<RowAccount> accounts{};     // [N] of the moving ones
};

// motion: one a joint; moves: [N][n], true where the joint surely moves one way; payload: which one the arm carries.
// torque is without what is known of the payload
RecordedRows make_recorded_rows(std::string recording, std::vector<Motion> const& motion,
                                std::vector<std::vector<bool>> const& moves, FilterOptions const& options,
                                ArmModel const& model, Section const& filter, std::optional<std::size_t> payload = {});

}  // namespace torquescope
