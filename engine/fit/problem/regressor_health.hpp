#pragma once
// Whether a recording can tell the parameters apart, in numbers and in words.
//
// Equation   condition = largest / smallest singular value of phi (raw) and of phi with columns of length one (scaled)
//            correlation_ij = phi_i . phi_j / (|phi_i| |phi_j|), not centred: an offset column counts too
// Limits     a pair is warned of above |correlation| 0.995, where each of the two is ten times less certain than alone;
//            above 0.95 (three times) it is worth a remark: every job with gravity and a travel below a turn has one,
//            and its intervals say what that costs. A group above scaled condition 30 (Belsley, Kuh, Welsch 1980)
// Errors     not_identifiable: Error 65 naming the columns and the motion that would separate them
// Threads    free functions

#include <Eigen/Core>
#include <string>

#include "engine/base/error.hpp"
#include "engine/fit/problem/regression_data.hpp"
#include "engine/fit/problem/row_reduction.hpp"

namespace torquescope {

// a direction of the column-scaled parameters with less than this share of the largest singular value is not in the
// data
inline constexpr double identifiable_threshold = 1e-10;

struct RegressorHealth {
  double condition_number = 0.0;      // of the column-scaled regressor: what limits the accuracy of a fit
  double condition_number_raw = 0.0;  // with units as they are: what limits a search that does not scale
  Eigen::MatrixXd correlation;        // [R][R]
  bool identifiable = true;
  // "" when healthy: "viscous and offset correlate 0.9971: trust what both make together, neither value by itself;
  // wider speeds would help"
  std::string words;
  std::string remark;  // of what is healthy: "offset and gravity_cos correlate 0.98: ..."; "" when words say more
};

// no row left over to measure an error with
bool too_few_rows(RegressionData const& data);

RegressorHealth regressor_health(RegressionData const& data);
// with the rows reduced already (row_reduction.hpp); not looked at where rows are too few
RegressorHealth regressor_health(RegressionData const& data, Reductions const& reductions);

// Requires   not regressor_health(data).identifiable
Error not_identifiable(RegressionData const& data);

}  // namespace torquescope
