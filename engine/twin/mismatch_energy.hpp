#pragma once
// How much of the residual the twins do not have: the omnibus test, and the measure that every gain is a share of.
//
// Mismatch   d = residual - mean residual of the twins
// Excess     ||d||^2 / (1 + 1/M) - sum over rows of the twins' variance: energy beyond what noise leaves, 0 on average
//            when nothing is missing
// z, p       of ||d||^2 among the same of each twin against the others (leave-one-out, both with their own scaling)
// Threads    free function
// Source     LESSONS items 7, 9, 12 of our own prototype

#include "engine/twin/mismatch_rows.hpp"

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
