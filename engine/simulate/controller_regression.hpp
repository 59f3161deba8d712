#pragma once
// One linear regression of the torque on what a controller of a given shape can see (controller_fit.hpp chooses
// shapes).
//
// Equation   u_k = sum of columns: e_k = r_(k+shift) - q_k; q_(k-i) - q_(k-i-1), i = 0 .. lags-1; r_(k+shift+j+1) -
//            r_(k+shift+j), j = -behind .. ahead-1; 1; t_k - t_0; terms of the reference fed forward; b_k and b_(k+1) -
//            b_k of a gear load b; sum_(i<=k) e_i last, if there is an integral
// Rank       columns of no use (a reference that never accelerates) get the coefficient 0 and an infinite error
// Shapes     signals: n samples; a regression: one number per row of `rows`, which ascend
// Requires   lags + 1 and behind - shift samples before every row, shift + ahead after it
// Threads    free functions

#include <Eigen/Core>
#include <vector>

#include "engine/simulate/loop_signals.hpp"
#include "engine/simulate/reference_term.hpp"

namespace torquescope {

using SampleRows = std::vector<Eigen::Index>;

// differences of the reference behind and ahead
struct ReferenceWindow {
  int behind = 0, ahead = 0;
};
// The narrow window is for looking at rows the fit has not seen: the higher differences of a smooth reference are
// nearly dependent, and their coefficients run wild at its corners. The wide one is for the controller: a velocity
// taken over several samples, a sample of computing time, a feedforward.
inline constexpr ReferenceWindow narrow_window{1, 1}, wide_window{5, 2};

struct ControllerColumns {
  int lags = 0, shift = 0;
  ReferenceWindow window = narrow_window;
  bool has_integral = true;
  std::vector<ReferenceTerm> terms{};  // their gains are not read
  bool has_gear_load = false;

  Eigen::Index differences() const { return window.behind + window.ahead; }
  Eigen::Index reference() const { return 1 + lags; }  // r_(i+1) - r_i, i = -behind first
  Eigen::Index constant() const { return reference() + differences(); }
  Eigen::Index drift() const { return constant() + 1; }
  Eigen::Index first_term() const { return drift() + 1; }
  Eigen::Index gear_load() const { return first_term() + static_cast<Eigen::Index>(terms.size()); }
  Eigen::Index integral() const { return gear_load() + (has_gear_load ? 2 : 0); }
  Eigen::Index count() const { return integral() + (has_integral ? 1 : 0); }
};

struct ControllerRegression {
  ControllerColumns columns;
  Eigen::VectorXd coefficients;
  Eigen::VectorXd errors;  // standard, if the residual is white; infinite where a column adds nothing
  Eigen::VectorXd residual;
  double sse = 0.0;
};

// [rows][columns.count()]
Eigen::MatrixXd controller_regressors(LoopSignals const& signals, ControllerColumns const& columns,
                                      SampleRows const& rows);

ControllerRegression regress_controller(LoopSignals const& signals, ControllerColumns const& columns,
                                        SampleRows const& rows);

// the controller's torque at every row, sensor drift included, before any limit; rows may be others than those of the
// fit
Eigen::VectorXd asked_torque(LoopSignals const& signals, ControllerRegression const& fit, SampleRows const& rows);

// every so manieth row, at most `most` of them
SampleRows thinned(SampleRows const& rows, std::size_t most);

Eigen::VectorXd picked(Eigen::VectorXd const& signal, SampleRows const& rows);

}  // namespace torquescope
