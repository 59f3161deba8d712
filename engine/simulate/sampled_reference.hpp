#pragma once
// A motion given at equal steps, as a file of samples holds it; repeated when its end is reached.
//
// Equation   between two samples the polynomial of degree 5 with their positions, velocities and accelerations
// Error      of the position h^6 max|q^(6)| / 46080, from the remainder q^(6) x^3 (h - x)^3 / 6!
// Units      s, rad (prismatic: m)
// Threads    const object, any number of threads

#include <Eigen/Core>
#include <memory>

#include "engine/simulate/reference.hpp"

namespace torquescope {

struct SampledMotion {
  double step_s = 0.0;
  Eigen::VectorXd q, dq, ddq;  // of one length, at least 2; the last sample is the first one of the repetition
};

std::unique_ptr<Reference const> sampled_reference(SampledMotion motion);

}  // namespace torquescope
