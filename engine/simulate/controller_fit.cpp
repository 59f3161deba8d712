#include "engine/simulate/controller_fit.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "engine/base/contract.hpp"
#include "engine/simulate/controller_limits.hpp"
#include "engine/simulate/controller_regression.hpp"
#include "engine/simulate/feedforward_search.hpp"

namespace torquescope {
namespace {

constexpr int largest_shift = 2;
constexpr std::array<int, 3> lag_ladder{3, 6, 12};
constexpr int most_lags = lag_ladder.back();
// two-sided normal quantiles: 1 % over four autocorrelations; 0.1 % for an integral or a shift to be there
constexpr double z_white = 3.02;
constexpr double z_coefficient = 3.29;
constexpr int limit_passes = 3;

// every regression uses the same samples, whatever its shift and lags
SampleRows usable_rows(Eigen::Index n) {
  SampleRows rows;
  for (Eigen::Index k = most_lags + 1; k + largest_shift + wide_window.ahead < n; ++k) rows.push_back(k);
  return rows;
}

// pairs of samples that both survived; rows ascend
std::array<double, 4> residual_acf(Eigen::VectorXd const& residual, SampleRows const& rows) {
  std::array<double, 4> acf{};
  double const energy = residual.squaredNorm();
  if (energy == 0.0) return acf;
  Eigen::VectorXd spread = Eigen::VectorXd::Zero(rows.back() - rows.front() + 1);
  for (Eigen::Index i = 0; i < residual.size(); ++i)
    spread[rows[static_cast<std::size_t>(i)] - rows.front()] = residual[i];
  for (std::size_t i = 0; i < acf.size(); ++i) acf[i] = autocorrelation(spread, acf_lags[i]);
  return acf;
}

bool white_enough(std::array<double, 4> const& acf, double bound) {
  return std::all_of(acf.begin(), acf.end(), [&](double value) { return std::abs(value) < bound; });
}

double white_bound(SampleRows const& rows) { return z_white / std::sqrt(static_cast<double>(rows.size())); }

using Terms = std::vector<ReferenceTerm>;

ControllerColumns columns_of(LoopSignals const& s, int lags, int shift, ReferenceWindow const& window,
                             Terms const& terms = {}) {
  return {lags, shift, window, true, terms, s.gear_load != nullptr};
}

// Both windows, by Schwarz's criterion: a controller that looks further back than the narrow one would be taken for a
// shifted one, and the wide one contains small shifts
int best_shift(LoopSignals const& s, Terms const& terms, SampleRows const& all) {
  constexpr std::size_t enough = 8192;
  SampleRows const rows = thinned(all, enough);
  double const n = static_cast<double>(rows.size());
  int best = 0;
  double least = std::numeric_limits<double>::infinity();
  for (int shift : {0, -1, 1, -2, 2})
    for (auto const& window : {narrow_window, wide_window}) {
      ControllerColumns const columns = columns_of(s, most_lags, shift, window, terms);
      double const sse = std::max(regress_controller(s, columns, rows).sse, std::numeric_limits<double>::min());
      // the neighbouring samples of the reference imitate a small shift: none, unless the likelihood says otherwise
      double const criterion = n * std::log(sse) + static_cast<double>(columns.count()) * std::log(n) +
                               (shift == 0 ? 0.0 : z_coefficient * z_coefficient);
      if (criterion < least) {
        least = criterion;
        best = shift;
      }
    }
  return best;
}

// For rows that the fit has not seen: the narrow window, unless the wide one explains so much more that the controller
// must look that far (a feedforward at the corners of a trapezoid)
ControllerColumns cautious_columns(LoopSignals const& s, int shift, Terms const& terms, SampleRows const& all) {
  constexpr std::size_t enough = 8192;
  SampleRows const rows = thinned(all, enough);
  ControllerColumns const narrow = columns_of(s, most_lags, shift, narrow_window, terms);
  ControllerColumns const wide = columns_of(s, most_lags, shift, wide_window, terms);
  double const n = static_cast<double>(rows.size());
  double const gain = n * std::log(regress_controller(s, narrow, rows).sse / regress_controller(s, wide, rows).sse);
  // Schwarz's criterion
  return gain > static_cast<double>(wide.count() - narrow.count()) * std::log(n) ? wide : narrow;
}

// none where the linear controller leaves nothing but white noise
Terms feedforward(LoopSignals const& s, int shift, SampleRows const& rows) {
  ControllerColumns const columns = columns_of(s, most_lags, shift, wide_window);
  auto const linear = regress_controller(s, columns, rows);
  if (white_enough(residual_acf(linear.residual, rows), white_bound(rows))) return {};
  return find_feedforward(s, columns, rows);
}

// Akaike: a lag too many costs nothing here, one too few bends the controller while the noise still looks white
ControllerRegression best_lags(LoopSignals const& s, int shift, Terms const& terms, SampleRows const& rows) {
  double const n = static_cast<double>(rows.size());
  ControllerRegression best;
  double least = std::numeric_limits<double>::infinity();
  for (int lags : lag_ladder)
    for (auto const& window : {narrow_window, wide_window}) {
      ControllerColumns const columns = columns_of(s, lags, shift, window, terms);
      ControllerRegression tried = regress_controller(s, columns, rows);
      double const criterion = n * std::log(std::max(tried.sse, std::numeric_limits<double>::min())) +
                               2.0 * static_cast<double>(columns.count());
      if (criterion < least) {
        least = criterion;
        best = std::move(tried);
      }
    }
  return best;
}

LoopController controller_of(ControllerRegression const& fit) {
  auto const& c = fit.coefficients;
  auto const& columns = fit.columns;
  LoopController controller;
  controller.shift = columns.shift;
  controller.position.assign(static_cast<std::size_t>(columns.lags) + 1, 0.0);
  controller.position[0] = -c[0];
  for (int lag = 0; lag < columns.lags; ++lag) {
    controller.position[static_cast<std::size_t>(lag)] += c[1 + lag];
    controller.position[static_cast<std::size_t>(lag) + 1] -= c[1 + lag];
  }
  Eigen::Index const differences = columns.differences();
  controller.behind = columns.window.behind;
  controller.reference.assign(static_cast<std::size_t>(differences) + 1, 0.0);
  controller.reference[static_cast<std::size_t>(columns.window.behind)] = c[0];
  for (Eigen::Index j = 0; j < differences; ++j) {
    controller.reference[static_cast<std::size_t>(j)] -= c[columns.reference() + j];
    controller.reference[static_cast<std::size_t>(j) + 1] += c[columns.reference() + j];
  }
  controller.terms = columns.terms;
  for (std::size_t j = 0; j < controller.terms.size(); ++j)
    controller.terms[j].gain = c[columns.first_term() + static_cast<Eigen::Index>(j)];
  if (columns.has_gear_load) controller.gear_load = {c[columns.gear_load()], c[columns.gear_load() + 1]};
  controller.constant = c[columns.constant()];
  controller.integral = columns.has_integral ? c[columns.integral()] : 0.0;
  return controller;
}

std::vector<LimitedSample> limited_samples(Eigen::VectorXd const& asked, SampleRows const& rows,
                                           ControllerLimits const& limits) {
  std::vector<LimitedSample> limited;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    double const want = asked[static_cast<Eigen::Index>(i)];
    double const beyond = want - std::clamp(want, limits.least, limits.most);
    if (beyond != 0.0) limited.push_back({rows[i], beyond});
  }
  return limited;
}

std::string in_words(ControllerFit const& fit) {
  if (fit.is_white)
    return fmt::format("the controller is identified (R^2 {:.6f}, white residual): torque noise {:.3g} rms",
                       fit.r_squared, fit.noise.std);
  return fmt::format(
      "the controller is only approximated (R^2 {:.6f}, residual autocorrelation {:.2f} {:.2f} {:.2f} {:.2f} "
      "at 1, 2, 5, 20 samples): replicates carry the residual's level and colour",
      fit.r_squared, fit.residual_acf[0], fit.residual_acf[1], fit.residual_acf[2], fit.residual_acf[3]);
}

}  // namespace

ControllerFit fit_controller(LoopSignals const& signals) {
  TORQUESCOPE_EXPECT(signals.position.size() >= 100 && signals.reference.size() == signals.position.size() &&
                     signals.torque.size() == signals.position.size());
  // which rows obey the controller at all; the first fit chose its rows by the torque, the next ones by the controller
  SampleRows const all = usable_rows(signals.position.size());
  SampleRows rows = inner_rows(signals, all);
  int shift = best_shift(signals, {}, rows);
  Terms terms = feedforward(signals, shift, rows);
  ControllerLimits limits;
  for (int pass = 0; pass < limit_passes; ++pass) {
    ControllerRegression const sofar = regress_controller(signals, cautious_columns(signals, shift, terms, rows), rows);
    limits = find_limits(signals, sofar, all);
    rows = limits.any() ? unclipped_rows(signals, sofar, limits, all) : all;
    if (pass == 0) shift = best_shift(signals, terms, rows);
    if (!limits.any()) break;
  }

  // the controller
  terms = feedforward(signals, shift, rows);
  ControllerRegression fit = best_lags(signals, shift, terms, rows);
  ControllerFit result;
  result.integral_z = fit.coefficients[fit.columns.integral()] / fit.errors[fit.columns.integral()];
  if (!(std::abs(result.integral_z) > z_coefficient)) {
    fit.columns.has_integral = false;
    fit = regress_controller(signals, fit.columns, rows);
  }
  result.controller = controller_of(fit);
  result.controller.least = limits.least;
  result.controller.most = limits.most;

  // what it leaves
  Eigen::VectorXd const torque = picked(signals.torque, rows);
  double const n = static_cast<double>(rows.size());
  result.r_squared = 1.0 - fit.sse / (torque.array() - torque.mean()).square().sum();
  result.residual_acf = residual_acf(fit.residual, rows);
  result.white_bound = white_bound(rows);
  result.is_white = white_enough(result.residual_acf, result.white_bound);
  double const std = std::sqrt(fit.sse / (n - static_cast<double>(fit.columns.count())));
  if (result.is_white) {
    result.noise = white(std);
  } else {
    result.noise = fit_autoregression(fit.residual);
    // the parameters of the controller took their share of the energy
    result.noise.innovation *= std / result.noise.std;
    result.noise.std = std;
  }
  result.drift_per_s = fit.coefficients[fit.columns.drift()];
  result.drift_z = result.drift_per_s / fit.errors[fit.columns.drift()];
  result.lags = fit.columns.lags;
  result.rows = static_cast<Eigen::Index>(rows.size());
  if (limits.any()) result.limited = limited_samples(asked_torque(signals, fit, all), all, limits);
  result.remark = in_words(result);
  return result;
}

}  // namespace torquescope
