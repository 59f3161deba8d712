#pragma once
// A discrete controller as its numbers, linear in what it measures: what an identified loop is, and what replicates are
// simulated with.
//
// Equation   u_k = constant + sum_i position[i] q_(k-i) + sum_j reference[j] r_(k+shift-behind+j) + integral sum_(i<=k)
//            e_i + sum of the terms of the reference fed forward + gear_load[0] b_k + gear_load[1] (b_(k+1) - b_k),
//            e_i = r_(i+shift) - q_i, then least <= u_k <= most; u_k is held until tick k+1. b: what other joints need
// Shapes     position: lags 0, 1, ...; reference: `behind` samples before k + shift, that one, and those ahead of it
// Units      q, r rad or m; u N m or N; gains their quotients
// Threads    plain record

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <limits>
#include <vector>

#include "engine/simulate/reference_term.hpp"

namespace torquescope {

struct LoopController {
  std::vector<double> position{};
  std::vector<double> reference{};
  std::vector<ReferenceTerm> terms{};
  std::array<double, 2> gear_load{};  // of an arm, fed forward; the second for a motion behind its reference
  int behind = 1;
  int shift = 0;
  double integral = 0.0;
  double constant = 0.0;
  double least = -std::numeric_limits<double>::infinity();
  double most = std::numeric_limits<double>::infinity();

  // u per unit of a constant error, without the integral; N m/rad or N/m
  double proportional_gain() const;
  // -u per unit of a constant velocity of the joint alone, beside the proportional part; N m s/rad or N s/m
  double velocity_gain(double rate_hz) const;
};

// [n] the part of u that the joint does not change: constant, reference and its terms, gear load ([n]; empty: none)
Eigen::VectorXd open_part(LoopController const& controller, Eigen::VectorXd const& reference,
                          Eigen::VectorXd const& gear_load = {});

// b_(k+1) - b_k, at the end the one before
inline double step_after(Eigen::VectorXd const& signal, Eigen::Index k) {
  Eigen::Index const from = std::min(k, signal.size() - 2);
  return signal[from + 1] - signal[from];
}

}  // namespace torquescope
