#pragma once
// Noise that least squares cannot see: Gaussian, with everything a regressor could fit taken out.
//
// Equation   e = s (I - Q Q') g,  Q = orthonormal basis of span(phi),  g standard normal,  s such that e'e / n = mse
// Property   phi' e = 0, so the least-squares fit of phi a + e is a, with residual e
// Why        only such data give back a published least-squares row (seed paper, CITATION.cff) to the last digit
// Shapes     phi: n x p with n > p; result: n

#include <Eigen/Core>

#include "engine/base/random_stream.hpp"

namespace torquescope {

Eigen::VectorXd orthogonal_noise(Eigen::MatrixXd phi, double mse, RandomKey const& key);

}  // namespace torquescope
