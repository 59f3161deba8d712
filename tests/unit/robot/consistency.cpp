#include "engine/robot/consistency.hpp"

#include <gtest/gtest.h>

#include <random>

#include "engine/robot/inverse_dynamics.hpp"
#include "engine/robot/pseudo_inertia.hpp"
#include "support/decompositions.hpp"
#include "unit/robot/example_arms.hpp"

namespace torquescope {
namespace consistency_test {

using Eigen::Index;

// as an identification leaves it: the information of moving rows, with a standard error of noise at each
struct Estimate {
  test::RandomArm arm;
  BaseParameters base;
  BaseEstimate truth;
};

Estimate estimate_of(std::uint32_t number, DriveInertias drives, double noise) {
  auto const arm = test::random_arm(number, number % 2 == 0);
  BaseParameters const base(arm.chain, drives);
  std::mt19937 bits(number);
  std::uniform_real_distribution<double> uniform(-2.0, 2.0);
  Index const n = arm.chain.size(), n_samples = 60;
  Eigen::MatrixXd rows(n * n_samples, base.size());
  for (Index sample = 0; sample < n_samples; ++sample) {
    auto const draw = [&] { return Eigen::VectorXd::NullaryExpr(n, [&](Index) { return uniform(bits); }).eval(); };
    rows.middleRows(n * sample, n) = base.pick(arm_regressor(arm.chain, draw(), draw(), draw(), drives));
  }
  Eigen::MatrixXd const covariance = noise * noise * test::inverse(rows.transpose() * rows);
  return {arm, base, {base.from_standard(standard_parameters(arm.chain, drives)), test::information_root(covariance)}};
}

// the estimate, off by `errors` standard errors in a random direction
BaseEstimate noisy(Estimate const& of, double errors, std::uint32_t seed) {
  std::mt19937 bits(seed);
  std::normal_distribution<double> normal;
  Eigen::VectorXd const off = Eigen::VectorXd::NullaryExpr(of.truth.values.size(), [&](Index) { return normal(bits); });
  BaseEstimate estimate = of.truth;
  estimate.values += errors * estimate.root.triangularView<Eigen::Lower>().solve(off);
  return estimate;
}

void expect_bodies(ConsistentParameters const& found, Index n) {
  for (Index i = 0; i < n; ++i)
    EXPECT_TRUE(is_positive_definite(pseudo_inertia(found.standard.segment<numbers_per_link>(numbers_per_link * i))));
  if (found.standard.size() > numbers_per_link * n) {
    EXPECT_GT(found.standard.tail(n).minCoeff(), 0.0);
  }
}

TEST(Consistency, OfBaseParametersOfBodiesCostsNothing) {
  for (std::uint32_t number = 0; number < 40; ++number) {
    auto const drives = number % 3 == 0 ? DriveInertias::left_out : DriveInertias::included;
    auto const of = estimate_of(number, drives, 0.01);
    auto const found = consistent_parameters(of.arm.chain, of.base, of.truth);
    EXPECT_TRUE(found.converged) << number;
    EXPECT_LT(found.distance, 1e-4) << number;
    EXPECT_LT((found.base - of.truth.values).norm(), 1e-9 * of.truth.values.norm()) << number;
    expect_bodies(found, of.arm.chain.size());
    auto const tau =
        inverse_dynamics(of.arm.chain, standard_parameters(of.arm.chain, drives), of.arm.q, of.arm.dq, of.arm.ddq);
    auto const ours = inverse_dynamics(of.arm.chain, found.standard, of.arm.q, of.arm.dq, of.arm.ddq);
    EXPECT_LT((ours - tau).norm(), 1e-9 * tau.norm()) << number;
  }
}

// Karush, Kuhn, Tucker: the slope of the distance, as a matrix of each link, is positive semidefinite and orthogonal to
// the link, as near as the gap that is told. The problem is convex, so nothing that is consistent is closer; the solver
// is not asked.
TEST(Consistency, OfAnyBaseParametersIsTheClosest) {
  int refused = 0;
  for (std::uint32_t number = 0; number < 40; ++number) {
    auto const of = estimate_of(number, DriveInertias::included, 0.5);
    auto const estimate = noisy(of, 3.0, number);
    auto const found = consistent_parameters(of.arm.chain, of.base, estimate);
    ASSERT_TRUE(found.converged) << number;
    expect_bodies(found, of.arm.chain.size());
    EXPECT_LE(found.gap, visible_gap);
    double const allowed = found.gap + 1e-8;  // the slope is a small difference of large products
    refused += found.distance > 0.1 ? 1 : 0;
    Index const n = of.arm.chain.size();
    // of |root (base - values)|^2 / 2 by a standard number: two differences are exact for a square
    Eigen::VectorXd const off = estimate.root.transpose() * (estimate.root * (found.base - estimate.values));
    Eigen::VectorXd slope(found.standard.size());
    for (Index k = 0; k < slope.size(); ++k)
      slope[k] = off.dot(of.base.from_standard(Eigen::VectorXd::Unit(slope.size(), k)));
    double orthogonal = 0.0;
    for (Index i = 0; i < n; ++i) {
      LinkVector const link = found.standard.segment<numbers_per_link>(numbers_per_link * i);
      LinkVector const g = slope.segment<numbers_per_link>(numbers_per_link * i);
      // Z with trace(Z dP/dk) = g_k: S = trace(I) / 2 - I gives xx the moments (-1, 1, 1) / 2, xy the moment -1
      PseudoInertia z = PseudoInertia::Zero();
      z(3, 3) = g[0];
      for (Index k = 0; k < 3; ++k) z(k, 3) = z(3, k) = 0.5 * g[1 + k];
      z(0, 0) = g[7] + g[9];
      z(1, 1) = g[4] + g[9];
      z(2, 2) = g[4] + g[7];
      z(0, 1) = z(1, 0) = -0.5 * g[5];
      z(0, 2) = z(2, 0) = -0.5 * g[6];
      z(1, 2) = z(2, 1) = -0.5 * g[8];
      for (Index k = 0; k < numbers_per_link; ++k)  // the table above is right
        ASSERT_NEAR(z.cwiseProduct(pseudo_inertia(LinkVector::Unit(k))).sum(), g[k], 1e-9 * (1.0 + g.norm()));
      // in the link's own scale
      Eigen::Vector4d const scale = pseudo_inertia(link).diagonal().cwiseSqrt();
      EXPECT_GT(test::eigenvalues(scale.asDiagonal() * z * scale.asDiagonal())[0], -allowed) << number;
      orthogonal += z.cwiseProduct(pseudo_inertia(link)).sum();
    }
    for (Index k = 10 * n; k < slope.size(); ++k) {
      EXPECT_GT(slope[k] * found.standard[k], -allowed) << number;
      orthogonal += slope[k] * found.standard[k];
    }
    EXPECT_NEAR(orthogonal, 0.0, allowed) << number;
  }
  EXPECT_GT(refused, 10);  // estimates that no bodies have were among them
}

TEST(Consistency, OfAPullIsBetweenEstimateAndPrior) {
  auto const of = estimate_of(7, DriveInertias::included, 0.5);
  auto const estimate = noisy(of, 2.0, 7);
  InertiaPrior prior;
  prior.links = of.arm.chain.links;
  for (auto const& joint : of.arm.chain.joints) prior.drives.push_back(joint.drive_inertia);
  auto const distances = [&](double weight) {
    prior.weight = weight;
    auto const found = consistent_parameters(of.arm.chain, of.base, estimate, prior);
    EXPECT_TRUE(found.converged) << weight;
    return std::pair{found.distance, found.divergence};
  };
  auto const [free, far] = distances(0.0);
  auto const [pulled, near] = distances(10.0);
  auto const [held, none] = distances(1e8);
  EXPECT_LT(free, pulled);
  EXPECT_LT(pulled, held);
  EXPECT_GT(far, near);
  EXPECT_GT(near, none);
  EXPECT_LT(none, 1e-6);
}

// what the data leave open is the prior's where the data agree with it
TEST(Consistency, TakesFromThePriorWhatTheDataLeaveOpen) {
  auto const of = estimate_of(9, DriveInertias::included, 0.01);
  InertiaPrior prior;
  prior.links = of.arm.chain.links;
  for (auto const& joint : of.arm.chain.joints) prior.drives.push_back(joint.drive_inertia);
  auto const found = consistent_parameters(of.arm.chain, of.base, of.truth, prior);
  auto const truth = standard_parameters(of.arm.chain, DriveInertias::included);
  EXPECT_LT((found.standard - truth).norm(), 1e-9 * truth.norm());
}

}  // namespace consistency_test
}  // namespace torquescope
