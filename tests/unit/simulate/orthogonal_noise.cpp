#include "engine/simulate/orthogonal_noise.hpp"

#include <gtest/gtest.h>

#include <Eigen/QR>
#include <cmath>
#include <span>

#include "engine/simulate/noise.hpp"

using namespace torquescope;

namespace orthogonal_noise_test {

RandomKey const key{21, 0, RandomDomain::simulation};

Eigen::MatrixXd random_regressor(Eigen::Index n, Eigen::Index p) {
  Eigen::MatrixXd phi(n, p);
  std::span const numbers(phi.data(), static_cast<std::size_t>(phi.size()));
  addressed_normals({99, 0, RandomDomain::test}, NoiseStream::torque_white, 0, numbers);
  return phi;
}

TEST(OrthogonalNoise, NoColumnCanSeeIt) {
  Eigen::MatrixXd phi = random_regressor(500, 4);
  phi.col(1) *= 1e6;  // another unit
  auto const noise = orthogonal_noise(phi, 0.25, key);
  for (auto const column : phi.colwise())
    EXPECT_LT(std::abs(column.dot(noise)) / (column.norm() * noise.norm()), 1e-15);
}

TEST(OrthogonalNoise, HasTheMeanSquareAskedFor) {
  auto const noise = orthogonal_noise(random_regressor(500, 4), 0.09259, key);
  EXPECT_NEAR(noise.squaredNorm() / 500.0, 0.09259, 1e-15);
}

TEST(OrthogonalNoise, ACopyOfAColumnTakesNothingMore) {
  Eigen::MatrixXd const phi = random_regressor(300, 3);
  Eigen::MatrixXd doubled(300, 5);
  doubled << phi, 2.0 * phi.col(0), Eigen::VectorXd::Zero(300);
  EXPECT_LT((orthogonal_noise(doubled, 1.0, key) - orthogonal_noise(phi, 1.0, key)).norm(), 1e-12);
}

TEST(OrthogonalNoise, OtherwiseLooksWhite) {
  constexpr Eigen::Index n = 4000;
  auto const noise = orthogonal_noise(random_regressor(n, 4), 1.0, key);
  double const lag_1 = noise.head(n - 1).dot(noise.tail(n - 1)) / n;
  EXPECT_NEAR(lag_1, 0.0, 5.0 / std::sqrt(double(n)));
}

}  // namespace orthogonal_noise_test
