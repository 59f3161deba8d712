// Instrumental variables: least squares whose regressor has no noise of the positions in it.
//
// Equation   Z = Phi along the motion of the identified arm, simulated without noise in the recording's loops;
//            P = Z (Z'Z)^-1 Z'Phi, x = (P'P)^-1 P'tau; then Z anew, until the prediction settles. With as many
//            instruments as parameters this is (Z'Phi)^-1 Z'tau
// Why        noise of the positions is in Phi and, through the loop, in tau: least squares is biased, without limit
// Arms       rows are divided by the noise of their joint, as wls. A joint alone has no instruments
// Errors     Error 65 without instruments, and when they do not tell the parameters apart
// Source     Janot, Vandanjon, Gautier 2014, doi:10.1109/TCST.2013.2246163; HAC errors of P's scores as of Phi's

#include <algorithm>
#include <cmath>

#include "engine/base/dense_solvers.hpp"
#include "engine/base/error.hpp"
#include "engine/fit/problem/estimator.hpp"
#include "engine/fit/problem/regressor_health.hpp"

namespace torquescope::estimators {
namespace {

struct IvOptions {
  std::int64_t max_iterations = 20;
  double tolerance = 1e-4;
  std::int64_t hac_lags = -1;

  static OptionTable<IvOptions> const& table() {
    static OptionTable<IvOptions> const table(
        "estimator",
        "instrumental variables from a simulation of the identified arm; needs recording.columns.reference",
        {{"max_iterations", &IvOptions::max_iterations, "1", 1, 1000, "simulations; stops here even if not converged"},
         {"tolerance", &IvOptions::tolerance, "1", 0.0, 0.1,
          "converged when the prediction changes by less than this share of the torque"},
         hac_lags_option<IvOptions>()});
    return table;
  }
};

Error no_instruments() {
  Problem problem;
  problem.code = ExitCode::bad_data;
  problem.key = "estimator";
  problem.what = "iv has no instruments: nothing says which motion the arm was asked to make";
  problem.help = "use wls, or record the commanded positions of an arm";
  return Error(problem);
}

// what instruments know of phi
Eigen::MatrixXd projected(Eigen::MatrixXd const& phi, Eigen::MatrixXd const& instruments, RegressionData const& data) {
  Eigen::VectorXd length = instruments.colwise().norm();
  for (auto& one : length) one = one > 0.0 ? one : 1.0;
  PivotedQr const qr(instruments * length.cwiseInverse().asDiagonal(), identifiable_threshold);
  if (qr.rank() < phi.cols()) throw not_identifiable(data);
  return qr.projected(phi, phi.cols());
}

LeastSquaresFit fit_iv(RegressionData const& data, IvOptions const& options) {
  if (!data.arm || !data.arm->instruments) throw no_instruments();
  LeastSquaresFit fit;
  fit.parameters = solve_weighted(data, {});
  fit.converged = false;
  fit.iterations = 0;
  RegressionData seen = data;
  while (!fit.converged && fit.iterations < options.max_iterations) {
    seen.phi = projected(data.phi, data.arm->instruments(fit.parameters), data);
    Eigen::VectorXd const next = solve_weighted(seen, {});
    fit.converged = (data.phi * (next - fit.parameters)).norm() <= options.tolerance * data.tau.norm();
    fit.parameters = next;
    ++fit.iterations;
  }
  if (!fit.converged) fit.remark = "not converged within max_iterations = " + std::to_string(options.max_iterations);

  // the residual is that of phi, its scores are those of P
  Eigen::VectorXd const residual = data.tau - data.phi * fit.parameters;
  seen.tau = seen.phi * fit.parameters + residual;
  auto const freedom = static_cast<double>(std::max<Eigen::Index>(data.rows() - data.parameters(), 1));
  double const variance = residual.squaredNorm() / freedom;
  Eigen::MatrixXd const bread = inverse_information(seen, {});
  fit.covariance_naive = variance * bread;
  fit.scale = std::sqrt(variance);
  finish_fit(fit, seen, residual, bread, options.hac_lags);
  fit.metrics = prediction_metrics(data, fit.parameters);
  return fit;
}

}  // namespace

EstimatorChoice iv() {
  return {"iv",
          "instrumental variables",
          "Janot, Vandanjon, Gautier 2014",
          IvOptions::table().describe(),
          prepare_with<IvOptions>(fit_iv),
          true};
}

}  // namespace torquescope::estimators
