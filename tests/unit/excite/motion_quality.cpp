#include "engine/fit/excite/motion_quality.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "engine/base/dense_solvers.hpp"
#include "engine/fit/excite/motion_space.hpp"
#include "support/decompositions.hpp"
#include "unit/excite/arm_rows.hpp"

namespace torquescope {
namespace motion_quality_test {

using Eigen::Index;

MotionSamples some_motion(SerialChain const& chain) {
  MotionSpace const space(chain, {}, 5, 10.0);
  std::vector<double> point(space.bounds().dimension());
  for (std::size_t i = 0; i < point.size(); ++i) point[i] = std::abs(std::sin(3.0 * static_cast<double>(i) + 1.0));
  return samples_of(space.motion(point), FourierTable(80, 5));
}

TEST(MotionQuality, IsThatOfTheStackedRows) {
  auto const chain = test::limited_crs(3);
  auto model = test::row_model(chain);
  model.noise = Eigen::Vector3d{2.0, 1.0, 0.5};
  auto const samples = some_motion(chain);
  auto const rows = model.rows(samples);
  Eigen::MatrixXd stacked = Eigen::MatrixXd::Zero(3 * 80, model.size);
  for (std::size_t j = 0; j < 3; ++j)
    for (std::size_t c = 0; c < model.own[j].size(); ++c)
      stacked.block(80 * static_cast<Index>(j), model.own[j][c], 80, 1) =
          rows[j].col(static_cast<Index>(c)) / model.noise[static_cast<Index>(j)];
  auto const quality = motion_quality(model, samples);
  // of the Gram: twice that of the triangle of QR
  double const log_determinant = 2.0 * triangle_of(stacked).diagonal().array().abs().log().sum();
  EXPECT_NEAR(quality.log_determinant, log_determinant / static_cast<double>(model.size), 1e-9);
  stacked.colwise().normalize();
  Eigen::VectorXd const values = test::singular_values(stacked);
  EXPECT_NEAR(quality.condition, values[0] / values[model.size - 1], 1e-8 * quality.condition);
}

// by projections and singular values, without a Gram
TEST(MotionQuality, TheAngleIsThatOfTheColumnsBesideAllOthers) {
  auto const chain = test::limited_crs(2);
  auto model = test::row_model(chain);
  auto const samples = some_motion(chain);
  auto const rows = model.rows(samples);
  Eigen::MatrixXd stacked = Eigen::MatrixXd::Zero(2 * 80, model.size);
  for (std::size_t j = 0; j < 2; ++j)
    for (std::size_t c = 0; c < model.own[j].size(); ++c)
      stacked.block(80 * static_cast<Index>(j), model.own[j][c], 80, 1) = rows[j].col(static_cast<Index>(c));
  // viscous of joint 1 and base parameter 0, from viscous and Coulomb of joint 2
  model.one = {model.size - 4, 0};
  model.other = {model.size - 2, model.size - 1};
  std::vector<Index> rest;
  for (Index k = 1; k < model.size; ++k)
    if (k != model.size - 4 && k < model.size - 2) rest.push_back(k);
  Eigen::MatrixXd const others = basis_of(stacked(Eigen::all, rest));
  auto const beside = [&](std::vector<Index> const& which) {
    Eigen::MatrixXd const columns = stacked(Eigen::all, which);
    return basis_of(columns - others * (others.transpose() * columns));
  };
  Eigen::MatrixXd const cosines = beside(model.one).transpose() * beside(model.other);
  double const expected = std::acos(test::singular_values(cosines)[0]);
  EXPECT_NEAR(motion_quality(model, samples).angle, expected, 1e-6);
  EXPECT_GT(expected, 0.1);
}

// 32 base parameters with drives (29 + 3), and viscous and Coulomb friction of five joints
TEST(MotionQuality, FiveJointsOfTheCrsCanBeTold) {
  auto const chain = test::limited_crs(5);
  auto const model = test::row_model(chain);
  EXPECT_EQ(model.size, 32 + 10);
  EXPECT_LT(motion_quality(model, some_motion(chain)).condition, 1e4);
}

TEST(MotionQuality, OfAnArmThatStandsStillIsInfinite) {
  auto const chain = test::limited_crs(2);
  MotionSamples const still{Eigen::VectorXd::Zero(5), Eigen::MatrixXd::Zero(5, 2), Eigen::MatrixXd::Zero(5, 2),
                            Eigen::MatrixXd::Zero(5, 2)};
  EXPECT_TRUE(std::isinf(motion_quality(test::row_model(chain), still).condition));
}

}  // namespace motion_quality_test
}  // namespace torquescope
