#pragma once
// A stationary noise as white noise through its own past: what a residual that is not white looks like, so that
// replicates can carry the same spectrum.
//
// Equation   x_k = sum_i a_i x_(k-i) + innovation n_k,  i = 1 .. order;  order 0 is white noise of this std
// Units      std and innovation in the unit of x
// Fit        Levinson and Durbin on the sample autocovariance; the order with the least n log(innovation^2) + 2 order
//            (Akaike) up to largest_order; always stable, because a sample autocovariance is positive semi-definite
// Threads    plain record, free functions
// Source     Brockwell, Davis 1991, Time Series: Theory and Methods, 5.2 and 9.3

#include <Eigen/Core>
#include <array>
#include <vector>

namespace torquescope {

struct Autoregression {
  double std = 0.0;
  double innovation = 0.0;
  std::vector<double> past{};  // a_1, a_2, ...
};

inline constexpr int largest_order = 30;

Autoregression white(double std);

// sum over t of x_t x_(t+lag) / sum x_t^2; not centred
double autocorrelation(Eigen::Ref<Eigen::VectorXd const> const& x, Eigen::Index lag);

Autoregression fit_autoregression(Eigen::Ref<Eigen::VectorXd const> const& x);

}  // namespace torquescope
