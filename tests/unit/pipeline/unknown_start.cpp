// Where what contacts remember of the time before a record ends.

#include "engine/infer/pipeline/unknown_start.hpp"

#include <gtest/gtest.h>

#include <cmath>

using torquescope::unknown_start;

namespace unknown_start_test {

// from rest: a creep of `creep` backwards for 100 samples, then strokes of 1 forwards and backwards in 400 samples each
Eigen::VectorXd creeping_start(double creep) {
  Eigen::VectorXd q(2100);
  for (Eigen::Index k = 0; k < q.size(); ++k) {
    auto const t = static_cast<double>(k);
    double const stroke = std::fmod(t - 100.0, 800.0) / 400.0;
    q[k] = t < 100.0 ? -creep * t / 100.0 : -creep + (stroke < 1.0 ? stroke : 2.0 - stroke);
  }
  return q;
}

Eigen::VectorXd speed_of(Eigen::VectorXd const& q) {
  Eigen::VectorXd dq = Eigen::VectorXd::Zero(q.size());
  if (q.size() == 0) return dq;
  dq.tail(q.size() - 1) = q.tail(q.size() - 1) - q.head(q.size() - 1);
  return dq;
}

Eigen::Index start_of(Eigen::VectorXd const& q) { return unknown_start(q, speed_of(q)); }

TEST(UnknownStart, EndsAfterTheFirstWayWithoutATurn) {
  // 6 % of a range of 1.01 along a stroke of 1 in 400 samples, counted from the turn at sample 100
  EXPECT_EQ(start_of(creeping_start(0.01)), 100 + 25);
}

TEST(UnknownStart, CountsWhateverWayIsLongEnough) {
  // the creep itself is
  EXPECT_LT(start_of(creeping_start(0.2)), 100);
}

TEST(UnknownStart, IsNoneWhereAllStrokesAreSmall) {
  Eigen::VectorXd q(4000);  // strokes of 0.1 that wander over a range of 4
  for (Eigen::Index k = 0; k < q.size(); ++k)
    q[k] = 0.001 * static_cast<double>(k) + 0.05 * std::sin(0.05 * static_cast<double>(k));
  EXPECT_EQ(start_of(q), 0);
}

TEST(UnknownStart, IsNoneWithoutMotion) {
  EXPECT_EQ(start_of(Eigen::VectorXd::Constant(100, 0.3)), 0);
  EXPECT_EQ(start_of(Eigen::VectorXd()), 0);
}

}  // namespace unknown_start_test
