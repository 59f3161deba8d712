#include "engine/simulate/orthogonal_noise.hpp"

#include <cmath>

#include "engine/base/contract.hpp"
#include "engine/base/dense_solvers.hpp"
#include "engine/simulate/noise.hpp"

namespace torquescope {

Eigen::VectorXd orthogonal_noise(Eigen::MatrixXd phi, double mse, RandomKey const& key) {
  TORQUESCOPE_EXPECT(phi.rows() > phi.cols() && mse >= 0.0);
  Eigen::Index const n = phi.rows();
  Eigen::VectorXd noise(n);
  addressed_normals(key, NoiseStream::orthogonal, 0, {noise.data(), static_cast<std::size_t>(n)});

  // columns of a common size, so that the rank does not depend on units
  for (auto column : phi.colwise())
    if (column.norm() > 0.0) column.normalize();
  Eigen::MatrixXd const basis = basis_of(phi);

  // twice: the second pass removes what the rounding of the first left
  for (int pass = 0; pass < 2; ++pass) noise -= basis * (basis.transpose() * noise).eval();
  return noise * std::sqrt(mse * static_cast<double>(n) / noise.squaredNorm());
}

}  // namespace torquescope
