#include "engine/robot/pseudo_inertia.hpp"

#include <Eigen/Cholesky>
#include <cmath>

#include "engine/base/contract.hpp"

namespace torquescope {

namespace {

using Factor = Eigen::LLT<PseudoInertia>;

Factor factor_of(PseudoInertia const& pseudo) {
  Factor factor(pseudo);
  TORQUESCOPE_EXPECT(factor.info() == Eigen::Success);
  return factor;
}

double log_determinant(Factor const& factor) {
  double sum = 0.0;
  for (Eigen::Index k = 0; k < 4; ++k) sum += 2.0 * std::log(factor.matrixLLT()(k, k));
  return sum;
}

}  // namespace

PseudoInertia pseudo_inertia(LinkVector const& link) {
  auto const body = LinkInertia::from_vector(link);
  PseudoInertia pseudo;
  pseudo.topLeftCorner<3, 3>() = 0.5 * body.inertia.trace() * Eigen::Matrix3d::Identity() - body.inertia;
  pseudo.topRightCorner<3, 1>() = body.first_moment;
  pseudo.bottomLeftCorner<1, 3>() = body.first_moment.transpose();
  pseudo(3, 3) = body.mass;
  return pseudo;
}

LinkVector link_vector(PseudoInertia const& pseudo) {
  Eigen::Matrix3d const moments = pseudo.topLeftCorner<3, 3>();
  LinkInertia body;
  body.mass = pseudo(3, 3);
  body.first_moment = pseudo.topRightCorner<3, 1>();
  body.inertia = moments.trace() * Eigen::Matrix3d::Identity() - moments;
  return body.vector();
}

bool is_positive_definite(PseudoInertia const& pseudo) { return Factor(pseudo).info() == Eigen::Success; }

double divergence(PseudoInertia const& pseudo, PseudoInertia const& prior) {
  auto const factor = factor_of(pseudo), prior_factor = factor_of(prior);
  return log_determinant(prior_factor) - log_determinant(factor) + prior_factor.solve(pseudo).trace() - 4.0;
}

PseudoInertia cholesky_factor(PseudoInertia const& pseudo) { return factor_of(pseudo).matrixL(); }

PseudoInertia inverse(PseudoInertia const& pseudo) { return factor_of(pseudo).solve(PseudoInertia::Identity()); }

}  // namespace torquescope
