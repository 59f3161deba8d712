#pragma once
// Least squares of all rows alike, with its errors: what ols does of a joint, and essential of the parameters it keeps.
//
// Errors     those of solve_weighted()
// Threads    free function

#include <cstdint>

#include "engine/fit/problem/least_squares.hpp"

namespace torquescope {

// hac_lags: -1 for automatic
LeastSquaresFit plain_least_squares(RegressionData const& data, std::int64_t hac_lags);

}  // namespace torquescope
