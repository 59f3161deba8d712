#pragma once
// The discrete controller of a recording: one linear regression of the torque on what a controller sees.
//
// Equation   u_k = kp e_k + ki sum_(i<=k) e_i + sum_i d_i (q_(k-i) - q_(k-i-1)) + sum_j f_j (r_(k+j+1) - r_(k+j)) +
//            terms of r and of the gear load fed forward + constant + drift t_k + noise;  e = r - q, i = 0 .. lags-1, j
//            = -5 .. 1, r read at k + shift. Choice of shift, lags, integral and terms: METHOD.md, The controller
// Limits     rows where the controller asks for more than the torque reaches are left out; that level becomes the
//            controller's limit
// White      |autocorrelation| at 1, 2, 5, 20 samples below 3.02 / sqrt(n): 1 % false alarms. Then the remainder is the
//            torque's noise; else replicates carry the remainder's own spectrum
// Shapes     n samples each, evenly spaced; n >= 100; the reference moves. Units: SI, noise in the torque's unit
// Threads    free function
// Source     Forssell, Ljung 1999, Closed-loop identification revisited, doi:10.1016/S0005-1098(99)00022-9

#include <Eigen/Core>
#include <array>
#include <string>
#include <vector>

#include "engine/simulate/autoregression.hpp"
#include "engine/simulate/loop_controller.hpp"
#include "engine/simulate/loop_signals.hpp"

namespace torquescope {

// at which the controller asks for more than the torque reaches
struct LimitedSample {
  Eigen::Index sample = 0;
  double beyond = 0.0;  // what it asks for, counted from the limit: positive at the upper one
};

struct ControllerFit {
  LoopController controller;
  Autoregression noise;  // of the torque measurement
  bool is_white = false;
  double r_squared = 0.0;
  std::array<double, 4> residual_acf{};  // at acf_lags
  double white_bound = 0.0;              // what each of them was held against
  double drift_per_s = 0.0, drift_z = 0.0;
  double integral_z = 0.0;  // before it was kept or dropped
  int lags = 0;
  Eigen::Index rows = 0;
  std::vector<LimitedSample> limited;  // in time order
  std::string remark;                  // a sentence for people: what is trusted, what is not
};

inline constexpr std::array<Eigen::Index, 4> acf_lags{1, 2, 5, 20};

ControllerFit fit_controller(LoopSignals const& signals);

}  // namespace torquescope
