#pragma once
// The discrete controller of a recording, by one linear regression of the torque on what a controller can see.
//
// Equation   u_k = kp e_k + ki sum_(i<=k) e_i + sum_i d_i (q_(k-i) - q_(k-i-1)) + sum_j f_j (r_(k+j+1) - r_(k+j)) +
//            terms of r fed forward + constant + drift t_k + noise;  e = r - q, i = 0 .. lags-1, j = -5 .. 1, r read at
//            k + shift
// Choice     shift in -2 .. 2 by the least residual, 0 unless another is better at 0.1 %; 3, 6 or 12 lags by Akaike's
//            criterion (a velocity filter needs more of the past than a difference)
// Terms      friction and gravity fed forward, when there are any (feedforward_search.hpp)
// Integral   kept only when significant at 0.1 %: beside a reference with a mean error its column is nearly a ramp
// Drift      of the torque sensor, for it is none of the loop's: part of the regression, not of the law
// Limits     rows where the law asks for more than the torque reaches are left out of the fit, and the torque's level
//            there becomes the limit of the law
// White      |autocorrelation| at 1, 2, 5 and 20 samples all below 3.02 / sqrt(n): 1 % false alarms in the family.
//            Then the residual is the noise of the torque measurement. When it is not white the law is a rougher copy
//            and noise carries the residual's own spectrum: level and colour of the twins stay those of the recording
// Units      SI; noise in the unit of the torque
// Shapes     n samples each, evenly spaced
// Requires   n >= 100 and a reference that moves
// Threads    free function
// Source     Forssell, Ljung 1999, Closed-loop identification revisited (the controller sees exactly what is regressed
//            on, so least squares is unbiased in closed loop); LESSONS items 1 and 2 of our own prototype

#include <Eigen/Core>
#include <array>
#include <string>
#include <vector>

#include "engine/simulate/autoregression.hpp"
#include "engine/simulate/loop_law.hpp"
#include "engine/simulate/loop_signals.hpp"

namespace torquescope {

// at which the law asks for more than the torque reaches
struct LimitedSample {
  Eigen::Index sample = 0;
  double beyond = 0.0;  // what it asks for, counted from the limit: positive at the upper one
};

struct ControllerFit {
  LoopLaw law;
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
