#pragma once
// All joints of an arm as one linear problem that every estimator of a joint can solve: rows below each other, those of
// a joint divided by its noise.
//
// Equation   tau_j / s_j = (Phi_j / s_j) x for all j: least squares of these rows is that weighted by 1 / s_j^2
// Shapes     n rows, R columns; one block of RegressionData::first_row for each joint of each recording, by recording
// Units      rows have none; parameters keep theirs
// Errors     Error 65 when recordings keep unequal rates
// Threads    free functions
// Source     Aitken 1935; Gautier 1997

#include <Eigen/Core>
#include <span>
#include <vector>

#include "engine/fit/problem/recorded_rows.hpp"
#include "engine/fit/problem/regression_data.hpp"

namespace torquescope {

enum class ArmRowChoice { moving, others };

// scale: [N] of each joint
RegressionData stack_rows(std::span<RecordedRows const> recordings, ArmRowChoice choice, ArmModel const& model,
                          Eigen::VectorXd const& scale, Section const& filter);

// the same rows with gains as they are stated: without the columns of their errors, which stand last
RegressionData with_stated_gains(RegressionData const& data);

// [n] of an arm's rows: with these weights every N m counts alike
Eigen::VectorXd unscaling_weights(RegressionData const& data);

}  // namespace torquescope
