#include "engine/simulate/controller_regression.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/base/dense_solvers.hpp"
#include "engine/simulate/loop_controller.hpp"

namespace torquescope {
namespace {

Eigen::VectorXd summed_error(LoopSignals const& s, int shift) {
  Eigen::Index const n = s.position.size();
  Eigen::VectorXd sum(n);
  double total = 0.0;
  for (Eigen::Index k = 0; k < n; ++k)
    sum[k] = total += s.reference[std::clamp<Eigen::Index>(k + shift, 0, n - 1)] - s.position[k];
  return sum;
}

}  // namespace

Eigen::MatrixXd controller_regressors(LoopSignals const& s, ControllerColumns const& columns, SampleRows const& rows) {
  ReferenceSignal const reference(s.reference);
  Eigen::VectorXd const sum = summed_error(s, columns.shift);
  auto const& q = s.position;
  auto const& r = s.reference;
  Eigen::MatrixXd x(static_cast<Eigen::Index>(rows.size()), columns.count());
  for (Eigen::Index i = 0; i < x.rows(); ++i) {
    Eigen::Index const k = rows[static_cast<std::size_t>(i)], at = k + columns.shift;
    x(i, 0) = r[at] - q[k];
    for (int lag = 0; lag < columns.lags; ++lag) x(i, 1 + lag) = q[k - lag] - q[k - lag - 1];
    for (Eigen::Index j = 0; j < columns.differences(); ++j)
      x(i, columns.reference() + j) = r[at - columns.window.behind + j + 1] - r[at - columns.window.behind + j];
    x(i, columns.constant()) = 1.0;
    x(i, columns.drift()) = s.time_s[k] - s.time_s[0];
    for (std::size_t j = 0; j < columns.terms.size(); ++j)
      x(i, columns.first_term() + static_cast<Eigen::Index>(j)) = columns.terms[j](reference, k);
    if (columns.has_gear_load) {
      x(i, columns.gear_load()) = (*s.gear_load)[k];
      x(i, columns.gear_load() + 1) = step_after(*s.gear_load, k);
    }
    if (columns.has_integral) x(i, columns.integral()) = sum[k];
  }
  return x;
}

SampleRows thinned(SampleRows const& rows, std::size_t most) {
  std::size_t const stride = (rows.size() + most - 1) / most;
  SampleRows some;
  for (std::size_t i = 0; i < rows.size(); i += stride) some.push_back(rows[i]);
  return some;
}

Eigen::VectorXd picked(Eigen::VectorXd const& signal, SampleRows const& rows) {
  Eigen::VectorXd result(static_cast<Eigen::Index>(rows.size()));
  for (Eigen::Index i = 0; i < result.size(); ++i) result[i] = signal[rows[static_cast<std::size_t>(i)]];
  return result;
}

ControllerRegression regress_controller(LoopSignals const& s, ControllerColumns const& columns,
                                        SampleRows const& rows) {
  Eigen::MatrixXd x = controller_regressors(s, columns, rows);
  Eigen::VectorXd const u = picked(s.torque, rows);
  Eigen::VectorXd length = x.colwise().norm();
  for (auto& one : length) one = one > 0.0 ? one : 1.0;
  x.array().rowwise() /= length.transpose().array();
  QrFactors const reduced = qr_factors_by_rows(x, u);
  // columns of no use (a reference that never accelerates) get 0, not a wild number
  PivotedQr const qr(reduced.r, 1e-12);

  ControllerRegression result{columns, qr.solve(reduced.q_right.col(0)), {}, {}, 0.0};
  result.residual = u - x * result.coefficients;
  result.sse = result.residual.squaredNorm();
  Eigen::Index const rank = qr.rank();
  Eigen::MatrixXd const inverse = qr.inverse_triangle();
  Eigen::VectorXi const order = qr.order();
  double const variance = result.sse / static_cast<double>(x.rows() - rank);
  Eigen::VectorXd errors = Eigen::VectorXd::Constant(columns.count(), std::numeric_limits<double>::infinity());
  for (Eigen::Index i = 0; i < rank; ++i) errors[order[i]] = std::sqrt(variance) * inverse.row(i).norm();
  result.coefficients.array() /= length.array();
  result.errors = errors.cwiseQuotient(length);
  return result;
}

Eigen::VectorXd asked_torque(LoopSignals const& s, ControllerRegression const& fit, SampleRows const& rows) {
  return controller_regressors(s, fit.columns, rows) * fit.coefficients;
}

}  // namespace torquescope
