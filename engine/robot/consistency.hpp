#pragma once
// The standard parameters of bodies that exist, closest to base parameters that were estimated.
//
// Equation   min |R (b(x) - b)|^2 / 2 + w sum of divergences(link, prior); every pseudo-inertia positive definite and
//            every drive inertia positive; b(x): base parameters of x; R: root of the information of the estimate, so
//            a unit is a standard error. w = 0: the least distance, and of all that have it the least divergence
// Method     convex: Newton steps along a shrinking barrier, which is the divergence itself. No smooth parametrisation
//            (log-Cholesky: Rucker, Wensing 2022, doi:10.1109/LRA.2022.3144517) is needed where steps stay inside
// Accuracy   the squared distance, to `gap` of its least
// Threads    pure function
// Source     pseudo_inertia.hpp; Boyd and Vandenberghe 2004, Convex Optimization, sections 9.6 and 11.3

#include <Eigen/Core>
#include <string>
#include <vector>

#include "engine/robot/base_parameters.hpp"

namespace torquescope {

struct BaseEstimate {
  // of BaseParameters, in their order; then of s more that are positive and beside the arm: frictions
  Eigen::VectorXd values;
  Eigen::MatrixXd root;  // R: R' R is the inverse of their covariance; (p + s) x (p + s)
};

struct InertiaPrior {
  // from CAD or a URDF, each a body; none, or without mass: a cube about the frame's origin, as long as the longest
  // link, of a mass that fits the largest inertia
  std::vector<LinkInertia> links{};
  std::vector<double> drives{};  // kg m^2 or kg; none: the cube's
  double weight = 0.0;           // squared standard errors per unit of divergence; 0: choose, do not pull
};

struct ConsistentParameters {
  Eigen::VectorXd standard;  // 10 N or 11 N, as the base parameters had them
  Eigen::VectorXd base;      // what they make of the base parameters
  Eigen::VectorXd beside{};  // those beside the arm
  double distance = 0.0;     // |R (base - values)|: what consistency costs, in standard errors
  double divergence = 0.0;   // of all links from their priors
  double gap = 0.0;          // of the squared distance above its least, at most about
  bool converged = false;    // gap is below visible_gap
  int steps = 0;
};

// squared standard errors. The first is aimed at. It stays away where no least exists, because the closer bodies are
// heavier without end: a small weight keeps them finite. The second is a hundredth of one parameter's variance
inline constexpr double largest_gap = 1e-10, visible_gap = 1e-2;

// Requires   root of full rank; priors without a prior_fault(), or of no mass, one a link, or none
ConsistentParameters consistent_parameters(SerialChain const& chain, BaseParameters const& base,
                                           BaseEstimate const& estimate, InertiaPrior const& prior = {});

// why nothing is near this body, though it may be one ("it has no thickness"), or ""
std::string prior_fault(LinkInertia const& link);

}  // namespace torquescope
