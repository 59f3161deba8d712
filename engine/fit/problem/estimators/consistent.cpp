// Links that exist: least squares of an arm over masses, centres and inertias of bodies, and frictions that brake.
//
// Equation   min |tau - Phi x|^2 / 2 + prior_weight * sum of divergences(link, prior); every pseudo-inertia positive
//            definite, drive inertias and frictions positive (robot/consistency.hpp); rows as wls weighs them
// Prior      the robot file's inertias; where it has none for a link a cube about the frame's origin
// Errors     of the parameters: those of wls here; limits that hold a parameter make its own smaller
// Source     Wensing, Kim, Slotine 2018, doi:10.1109/LRA.2017.2729659; Lee, Wensing, Park 2020,
//            doi:10.1109/TRO.2019.2926491 (the divergence)

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "engine/base/dense_solvers.hpp"
#include "engine/base/error.hpp"
#include "engine/fit/problem/arm_model.hpp"
#include "engine/fit/problem/estimator.hpp"
#include "engine/robot/consistency.hpp"

namespace torquescope::estimators {
namespace {

using Eigen::Index;

struct ConsistentOptions {
  // a link twice as heavy as its prior, alike otherwise, is 1.2 away: it costs as much as one parameter that is 1.6
  // standard errors off. Recordings that tell a mass to a few per cent hardly feel that
  double prior_weight = 1.0;
  std::int64_t hac_lags = -1;

  static OptionTable<ConsistentOptions> const& table() {
    static OptionTable<ConsistentOptions> const table(
        "estimator", "weighted least squares of an arm whose links are bodies: full inertial parameters of every link",
        {{"prior_weight", &ConsistentOptions::prior_weight, "1", 1e-6, 1e6,
          "pull towards the robot file's inertias, or cubes: half squared standard errors per divergence; a link twice "
          "as heavy is 1.2 away"},
         hac_lags_option<ConsistentOptions>()});
    return table;
  }
};

// The parameters in the order of the triangle: those of any value, which are solved for at the end; base parameters;
// frictions, each turned so that what exists is positive
struct ParameterOrder {
  std::vector<Index> order;
  Index n_free = 0, n_base = 0;
  Eigen::VectorXd sign;  // of each in that order

  explicit ParameterOrder(ArmModel const& model) : n_base(model.base().size()) {
    Eigen::VectorXd const signs = model.passive_signs();
    auto const n = static_cast<Index>(model.size());
    for (Index k = n_base; k < n; ++k)
      if (signs[k] == 0.0) order.push_back(k);
    n_free = static_cast<Index>(order.size());
    for (Index k = 0; k < n_base; ++k) order.push_back(k);
    for (Index k = n_base; k < n; ++k)
      if (signs[k] != 0.0) order.push_back(k);
    sign = signs(order);
    sign.head(n_free + n_base).setOnes();
  }
};

InertiaPrior prior_of(SerialChain const& chain, double weight) {
  InertiaPrior prior;
  prior.weight = weight;
  for (auto const& link : chain.links) prior.links.push_back(prior_fault(link).empty() ? link : LinkInertia());
  for (auto const& joint : chain.joints) prior.drives.push_back(joint.drive_inertia);
  return prior;
}

std::string remark_of(ConsistentParameters const& found, InertiaPrior const& prior) {
  auto const is_known = [](LinkInertia const& link) { return link.mass > 0.0; };
  auto const known = std::count_if(prior.links.begin(), prior.links.end(), is_known);
  std::string text = fmt::format("every link is a body, {:.3g} standard errors from wls, ", found.distance);
  text += known == 0 ? "near cubes: the robot file has no inertias" : "near the inertias of the robot file";
  if (known > 0 && known < static_cast<std::ptrdiff_t>(prior.links.size()))
    text += fmt::format(", which has {} of {}", known, prior.links.size());
  return text + (found.converged ? "" : "; not converged: a larger prior_weight keeps what nothing limits finite");
}

LeastSquaresFit fit_consistent(RegressionData const& data, ConsistentOptions const& options) {
  if (!data.arm) {
    Problem problem;
    problem.code = ExitCode::bad_data;
    problem.key = "estimator";
    problem.what = "consistent is of arms: a joint alone has no links";
    problem.help = "use wls, or write model.robot = \"arm.urdf\" and record all joints";
    throw Error(problem);
  }
  ArmModel const& model = *data.arm->model;
  ParameterOrder const at(model);
  LeastSquaresFit fit;
  fit.parameters = solve_weighted(data, {});  // refuses what no estimator can fit

  Eigen::MatrixXd const columns = data.phi(Eigen::all, at.order) * at.sign.asDiagonal();
  auto const qr = qr_factors_by_rows(columns, data.tau);
  Index const m = data.parameters() - at.n_free;
  Eigen::VectorXd const plain = at.sign.cwiseProduct(fit.parameters(at.order));
  InertiaPrior const prior = prior_of(model.chain(), options.prior_weight);
  auto const found =
      consistent_parameters(model.chain(), model.base(), {plain.tail(m), qr.r.bottomRightCorner(m, m)}, prior);

  Eigen::VectorXd ordered(data.parameters());
  ordered.segment(at.n_free, at.n_base) = found.base;
  ordered.tail(m - at.n_base) = found.beside;
  if (at.n_free > 0) {
    Eigen::VectorXd const rest =
        qr.q_right.col(0).head(at.n_free) - qr.r.topRightCorner(at.n_free, m) * ordered.tail(m);
    ordered.head(at.n_free) = qr.r.topLeftCorner(at.n_free, at.n_free).triangularView<Eigen::Upper>().solve(rest);
  }
  fit.parameters(at.order) = at.sign.cwiseProduct(ordered);
  fit.standard = {model.base().standard_names(), found.standard};
  fit.iterations = found.steps;
  fit.converged = found.converged;
  fit.remark = remark_of(found, prior);

  Eigen::VectorXd const residual = data.tau - data.phi * fit.parameters;
  auto const freedom = static_cast<double>(std::max<Index>(data.rows() - data.parameters(), 1));
  double const variance = residual.squaredNorm() / freedom;
  auto const bread = inverse_information(data, {});
  fit.covariance_naive = variance * bread;
  fit.scale = std::sqrt(variance);
  finish_fit(fit, data, residual, bread, options.hac_lags);
  return fit;
}

}  // namespace

EstimatorChoice consistent() {
  return {"consistent",
          "links that are bodies",
          "Wensing, Kim, Slotine 2018",
          ConsistentOptions::table().describe(),
          prepare_with<ConsistentOptions>(fit_consistent),
          false,
          false,
          true};
}

}  // namespace torquescope::estimators
