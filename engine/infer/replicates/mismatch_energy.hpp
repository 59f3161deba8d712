#pragma once
// How much of the residual the replicates do not have: the overall test, and the measure that every gain is a share of.
//
// Equation   d = residual - mean residual of the replicates
//            excess = ||d||^2 / (1 + 1/M) - sum over rows of the replicates' variance: 0 on average when nothing is
//            missing
// z, p       of ||d||^2 among the same of each replicate against the others (leave-one-out, each with its own scaling)
// Threads    free function
// Source     engine/infer/moving_rows/THEORY.md, Null distribution

#include "engine/infer/replicates/mismatch_rows.hpp"

namespace torquescope {

struct MismatchEnergy {
  double excess = 0.0;    // may be below 0 by chance
  double noise = 0.0;     // energy that noise alone leaves in d, on average
  double residual = 0.0;  // ||residual||^2
  double z = 0.0, p = 1.0;
  Eigen::Index rows = 0;

  double excess_rms() const;
};

MismatchEnergy mismatch_energy(MismatchRows const& rows);

}  // namespace torquescope
