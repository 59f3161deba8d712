// Which directions a joint may correct, against counting by hand, and that its own terms keep their meaning.

#include "engine/diagnose/arms/rigid_corrections.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "engine/effects/regressor.hpp"

namespace torquescope {
namespace rigid_corrections_test {

constexpr Eigen::Index n = 4000;

Motion moved() {
  Motion motion;
  motion.rate_hz = 200.0;
  motion.time_s = Eigen::VectorXd::LinSpaced(n, 0.0, (n - 1) / motion.rate_hz);
  Eigen::ArrayXd const t = motion.time_s.array();
  motion.q = (1.3 * t).sin() + 0.4 * (2.9 * t).sin();
  motion.dq = 1.3 * (1.3 * t).cos() + 1.16 * (2.9 * t).cos();
  motion.ddq = -1.69 * (1.3 * t).sin() - 3.364 * (2.9 * t).sin();
  motion.torque = Eigen::VectorXd::Zero(n);
  return motion;
}

// three directions: one of gravity that this joint alone tells, one that others tell better, one of the acceleration
Eigen::MatrixXd errors_of(Motion const& motion, double noise) {
  Eigen::MatrixXd errors(n, 3);
  Eigen::VectorXd const weight = motion.q.array().cos(), swing = (1.7 * motion.time_s.array()).sin();
  errors.col(0) = weight * noise / (weight.array() - weight.mean()).matrix().norm();
  errors.col(1) = 0.4 * noise * swing.normalized();
  errors.col(2) = noise * motion.ddq.normalized();
  return errors;
}

TEST(RigidCorrections, AreOfWhatTheJointTellsMostOf) {
  constexpr double noise = 0.3;
  Motion const motion = moved();
  CorrectionSums sums;
  sums.add(motion, errors_of(motion, noise));
  RigidCorrections const found = sums.corrections(noise, n);
  // 0.4^2 of the second is less than half, and the third is the joint's own inertia
  ASSERT_EQ(found.size(), 1);
  EXPECT_GT(std::abs(found.directions(0, 0)), 0.95);
}

TEST(RigidCorrections, CountRowsOfTheFitAndNotSamples) {
  constexpr double noise = 0.3;
  Motion const motion = moved();
  CorrectionSums sums;
  sums.add(motion, errors_of(motion, noise));
  // a quarter of the rows with the same errors: each row tells four times as much
  EXPECT_EQ(sums.corrections(noise, n / 4).size(), 0);
  EXPECT_EQ(sums.corrections(noise, 4 * n).size(), 2);
}

TEST(RigidCorrections, LeaveTheJointsOwnTermsTheirMeaning) {
  constexpr double noise = 0.3;
  Motion const motion = moved();
  Eigen::MatrixXd const errors = errors_of(motion, noise);
  CorrectionSums sums;
  sums.add(motion, errors);
  Eigen::MatrixXd const columns = correction_columns(sums.corrections(noise, n), motion, errors);
  for (Eigen::VectorXd const& own : {motion.ddq, motion.dq, Eigen::VectorXd(motion.dq.array().sign())})
    EXPECT_LT((own.transpose() * columns).norm(), 1e-8 * own.norm() * columns.norm());
}

TEST(CorrectionTerm, TakesItsColumnsFromTheRecording) {
  auto const term = correction_term(2);
  Regressor const own({"inertia", "viscous"}, JointKind::revolute);
  Regressor const both = own.beside(*term);
  ASSERT_EQ(both.size(), 4U);
  Motion const motion = moved();
  GivenSignals given;
  given.laws.push_back({corrections_name, Eigen::MatrixXd::Random(n, 2)});
  EXPECT_EQ(both.columns(motion, &given).rightCols(2), given.laws.front().columns);
  EXPECT_EQ(both.columns(motion, &given).leftCols(2), own.columns(motion));
  EXPECT_TRUE(both.columns(motion).rightCols(2).isZero(0.0));
}

}  // namespace rigid_corrections_test
}  // namespace torquescope
