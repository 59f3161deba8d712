#pragma once
// Periodic motion of an arm as finite Fourier series, which begins and ends at rest.
//
// Equation   dq_j(t) = sum over k = 1 .. K of a_jk cos(k w t) + b_jk sin(k w t), w = 2 pi / period; q and ddq by
//            integration (about centre_j) and differentiation
// Rest       sum of a_jk = 0 and sum of k b_jk = 0: no speed and no acceleration at t = 0
// Shapes     N joints, K harmonics; samples n x N
// Units      s; rad, rad/s, rad/s^2 (prismatic: m)
// Bits       the same on every machine: sines by kernels/elementary.hpp
// Source     Swevers et al. 1997, doi:10.1109/70.631234

#include <Eigen/Core>
#include <vector>

namespace torquescope {

struct FourierJoint {
  double centre = 0.0;
  Eigen::VectorXd cosine, sine;  // a, b: rad/s
};

struct FourierMotion {
  double period_s = 1.0;
  std::vector<FourierJoint> joints;
};

struct MotionSamples {
  Eigen::VectorXd time_s;
  Eigen::MatrixXd q, dq, ddq;
};

// cos(k w t) and sin(k w t) at equal steps of a period: n x K
struct FourierTable {
  FourierTable(Eigen::Index samples, Eigen::Index harmonics);
  Eigen::MatrixXd cosine, sine;
};

// at the table's instants
MotionSamples samples_of(FourierMotion const& motion, FourierTable const& table);

}  // namespace torquescope
