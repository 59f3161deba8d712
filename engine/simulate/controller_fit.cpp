#include "engine/simulate/controller_fit.hpp"

#include <fmt/format.h>

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include "engine/base/contract.hpp"

namespace torquescope {
namespace {

constexpr int largest_shift = 2;
// Differences of the reference behind and ahead. The narrow window is for looking at rows the fit has not seen: the
// higher differences of a smooth reference are nearly dependent, and their coefficients run wild at its corners. The wide
// one is for the law: a velocity taken over several samples, a sample of computing time, a feedforward.
constexpr int few_behind = 1, few_ahead = 1;
constexpr int most_behind = 5, most_ahead = 2;
constexpr std::array<int, 3> lag_ladder{3, 6, 12};
constexpr int most_lags = lag_ladder.back();
// two-sided normal quantiles: 1 % over four autocorrelations; 0.1 % for an integral or a shift to be there
constexpr double z_white = 3.02;
constexpr double z_coefficient = 3.29;
// deviations by which a limit must explain better than the law, and in how many rows
constexpr double z_clipped = 6.0;
constexpr std::size_t fewest_clipped = 3;
constexpr int limit_passes = 3;

using Rows = std::vector<Eigen::Index>;

// every regression uses the same samples, whatever its shift and lags
Rows usable_rows(Eigen::Index n) {
  Rows rows;
  for (Eigen::Index k = most_lags + 1; k + largest_shift + most_ahead < n; ++k) rows.push_back(k);
  return rows;
}

// columns: e, differences of q, differences of r from behind to ahead, 1, t, [sum of e last]
struct Columns {
  int lags = 0, shift = 0;
  int behind = few_behind, ahead = few_ahead;
  bool has_integral = true;

  Eigen::Index count() const { return integral() + (has_integral ? 1 : 0); }
  Eigen::Index reference() const { return 1 + lags; }  // r_(i+1) - r_i, i = -behind first
  Eigen::Index constant() const { return reference() + behind + ahead; }
  Eigen::Index drift() const { return constant() + 1; }
  Eigen::Index integral() const { return drift() + 1; }
};

Eigen::VectorXd summed_error(LoopSignals const& s, int shift) {
  Eigen::Index const n = s.position.size();
  Eigen::VectorXd sum(n);
  double total = 0.0;
  for (Eigen::Index k = 0; k < n; ++k)
    sum[k] = total += s.reference[std::clamp<Eigen::Index>(k + shift, 0, n - 1)] - s.position[k];
  return sum;
}

Eigen::MatrixXd regressors(LoopSignals const& s, Columns const& columns, Rows const& rows) {
  Eigen::VectorXd const sum = summed_error(s, columns.shift);
  auto const& q = s.position;
  auto const& r = s.reference;
  Eigen::MatrixXd x(static_cast<Eigen::Index>(rows.size()), columns.count());
  for (Eigen::Index i = 0; i < x.rows(); ++i) {
    Eigen::Index const k = rows[static_cast<std::size_t>(i)], at = k + columns.shift;
    x(i, 0) = r[at] - q[k];
    for (int lag = 0; lag < columns.lags; ++lag) x(i, 1 + lag) = q[k - lag] - q[k - lag - 1];
    for (int j = 0; j < columns.behind + columns.ahead; ++j)
      x(i, columns.reference() + j) = r[at - columns.behind + j + 1] - r[at - columns.behind + j];
    x(i, columns.constant()) = 1.0;
    x(i, columns.drift()) = s.time_s[k] - s.time_s[0];
    if (columns.has_integral) x(i, columns.integral()) = sum[k];
  }
  return x;
}

Eigen::VectorXd picked(Eigen::VectorXd const& signal, Rows const& rows) {
  Eigen::VectorXd result(static_cast<Eigen::Index>(rows.size()));
  for (Eigen::Index i = 0; i < result.size(); ++i) result[i] = signal[rows[static_cast<std::size_t>(i)]];
  return result;
}

struct Regression {
  Columns columns;
  Eigen::VectorXd coefficients;
  Eigen::VectorXd errors;  // standard, if the residual is white; infinite where a column adds nothing
  Eigen::VectorXd residual;
  double sse = 0.0;
};

Regression regress(LoopSignals const& s, Columns const& columns, Rows const& rows) {
  Eigen::MatrixXd x = regressors(s, columns, rows);
  Eigen::VectorXd const u = picked(s.torque, rows);
  Eigen::VectorXd length = x.colwise().norm();
  for (auto& one : length) one = one > 0.0 ? one : 1.0;
  Eigen::MatrixXd const scaled = x * length.cwiseInverse().asDiagonal();
  // columns of no use (a reference that never accelerates) get 0, not a wild number
  Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr;
  qr.setThreshold(1e-12);
  qr.compute(scaled);

  Regression result{columns, qr.solve(u), {}, {}, 0.0};
  result.residual = u - scaled * result.coefficients;
  result.sse = result.residual.squaredNorm();
  Eigen::Index const rank = qr.rank();
  Eigen::MatrixXd const inverse = qr.matrixR()
                                      .topLeftCorner(rank, rank)
                                      .triangularView<Eigen::Upper>()
                                      .solve(Eigen::MatrixXd::Identity(rank, rank));
  double const variance = result.sse / static_cast<double>(x.rows() - rank);
  Eigen::VectorXd errors = Eigen::VectorXd::Constant(columns.count(), std::numeric_limits<double>::infinity());
  for (Eigen::Index i = 0; i < rank; ++i)
    errors[qr.colsPermutation().indices()[i]] = std::sqrt(variance) * inverse.row(i).norm();
  result.coefficients.array() /= length.array();
  result.errors = errors.cwiseQuotient(length);
  return result;
}

// pairs of samples that both survived; rows ascend
std::array<double, 4> residual_acf(Eigen::VectorXd const& residual, Rows const& rows) {
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

double white_bound(Rows const& rows) { return z_white / std::sqrt(static_cast<double>(rows.size())); }

int best_shift(LoopSignals const& s, Rows const& rows) {
  double const n = static_cast<double>(rows.size());
  int best = 0;
  double least = std::numeric_limits<double>::infinity();
  for (int shift : {0, -1, 1, -2, 2}) {
    double const sse = std::max(regress(s, {most_lags, shift}, rows).sse, std::numeric_limits<double>::min());
    // the neighbouring samples of the reference imitate a small shift: none, unless the likelihood says otherwise
    double const criterion = n * std::log(sse) + (shift == 0 ? 0.0 : z_coefficient * z_coefficient);
    if (criterion < least) {
      least = criterion;
      best = shift;
    }
  }
  return best;
}

// Akaike: a lag too many costs nothing here, one too few bends the law while the noise still looks white
Regression best_lags(LoopSignals const& s, int shift, Rows const& rows) {
  double const n = static_cast<double>(rows.size());
  Regression best;
  double least = std::numeric_limits<double>::infinity();
  for (int lags : lag_ladder)
    for (bool const wide : {false, true}) {
      Columns const columns{lags, shift, wide ? most_behind : few_behind, wide ? most_ahead : few_ahead};
      Regression tried = regress(s, columns, rows);
      double const criterion = n * std::log(std::max(tried.sse, std::numeric_limits<double>::min())) +
                               2.0 * static_cast<double>(columns.count());
      if (criterion < least) {
        least = criterion;
        best = std::move(tried);
      }
    }
  return best;
}

LoopLaw law_of(Regression const& fit) {
  auto const& c = fit.coefficients;
  auto const& columns = fit.columns;
  LoopLaw law;
  law.shift = columns.shift;
  law.position.assign(static_cast<std::size_t>(columns.lags) + 1, 0.0);
  law.position[0] = -c[0];
  for (int lag = 0; lag < columns.lags; ++lag) {
    law.position[static_cast<std::size_t>(lag)] += c[1 + lag];
    law.position[static_cast<std::size_t>(lag) + 1] -= c[1 + lag];
  }
  int const differences = columns.behind + columns.ahead;
  law.behind = columns.behind;
  law.reference.assign(static_cast<std::size_t>(differences) + 1, 0.0);
  law.reference[static_cast<std::size_t>(columns.behind)] = c[0];
  for (int j = 0; j < differences; ++j) {
    law.reference[static_cast<std::size_t>(j)] -= c[columns.reference() + j];
    law.reference[static_cast<std::size_t>(j) + 1] += c[columns.reference() + j];
  }
  law.constant = c[columns.constant()];
  law.integral = columns.has_integral ? c[columns.integral()] : 0.0;
  return law;
}

// the law's torque at every row, sensor drift included, before any limit
Eigen::VectorXd asked_torque(LoopSignals const& s, Regression const& fit, Rows const& rows) {
  return regressors(s, fit.columns, rows) * fit.coefficients;
}

struct Limits {
  double least = -std::numeric_limits<double>::infinity();
  double most = std::numeric_limits<double>::infinity();
  bool any() const { return std::isfinite(least) || std::isfinite(most); }
};

// The inner part of the torque's range, where no limit can be. Choosing rows by the torque itself biases a little, hence
// only for the first looks: alignment and limits.
Rows inner_rows(LoopSignals const& s, Rows const& rows) {
  double const top = s.torque.maxCoeff(), bottom = s.torque.minCoeff();
  Rows inner;
  for (auto k : rows)
    if (s.torque[k] < 0.9 * top + 0.1 * bottom && s.torque[k] > 0.9 * bottom + 0.1 * top) inner.push_back(k);
  return inner.size() >= rows.size() / 10 ? inner : rows;
}

// The level at which the torque stops following the law upwards: the rows where the law asks for most, as many as are
// explained better by one common level than by the law; infinite when six deviations do not tell the two apart.
// asked, torque: negated for the lower limit
double upper_limit(Eigen::VectorXd const& asked, Eigen::VectorXd const& torque, double deviation) {
  std::vector<Eigen::Index> order(static_cast<std::size_t>(asked.size()));
  std::iota(order.begin(), order.end(), Eigen::Index{0});
  std::sort(order.begin(), order.end(), [&](auto a, auto b) { return asked[a] > asked[b]; });
  double limit = std::numeric_limits<double>::infinity();
  double best = z_clipped * z_clipped * deviation * deviation;
  double sum = 0.0, by_law = 0.0, squares = 0.0;
  double const origin = torque[order.front()];  // the torque's own size must not swallow its spread
  for (std::size_t i = 0; i < order.size() / 2; ++i) {
    double const u = torque[order[i]] - origin, excess = torque[order[i]] - asked[order[i]];
    sum += u;
    squares += u * u;
    by_law += excess * excess;
    double const count = static_cast<double>(i + 1);
    double const gain = by_law - (squares - sum * sum / count);
    if (i + 1 < fewest_clipped || gain <= best) continue;
    // a torque that was reached lies under the limit, or there is none
    if (torque.maxCoeff() > origin + sum / count + z_clipped * deviation) continue;
    best = gain;
    limit = origin + sum / count;
  }
  return limit;
}

Limits find_limits(LoopSignals const& s, Regression const& fit, Rows const& rows) {
  double const deviation = std::sqrt(fit.sse / static_cast<double>(fit.residual.size()));
  Eigen::VectorXd const asked = asked_torque(s, fit, rows), torque = picked(s.torque, rows);
  return {-upper_limit(-asked, -torque, deviation), upper_limit(asked, torque, deviation)};
}

// rows where the law asks for less than the limits: told by what it sees, not by the torque
Rows unclipped_rows(LoopSignals const& s, Regression const& fit, Limits const& limits, Rows const& rows) {
  Eigen::VectorXd const asked = asked_torque(s, fit, rows);
  Rows inside;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    double const want = asked[static_cast<Eigen::Index>(i)];
    if (want < limits.most && want > limits.least) inside.push_back(rows[i]);
  }
  return inside;
}

std::string in_words(ControllerFit const& fit) {
  if (fit.is_white)
    return fmt::format("the controller is identified (R^2 {:.6f}, white residual): torque noise {:.3g} rms",
                       fit.r_squared, fit.noise.std);
  return fmt::format(
      "the controller is only approximated (R^2 {:.6f}, residual autocorrelation {:.2f} {:.2f} {:.2f} {:.2f} at 1, 2, "
      "5, "
      "20 samples): twins carry the residual's level and colour",
      fit.r_squared, fit.residual_acf[0], fit.residual_acf[1], fit.residual_acf[2], fit.residual_acf[3]);
}

}  // namespace

ControllerFit fit_controller(LoopSignals const& signals) {
  TORQUESCOPE_EXPECT(signals.position.size() >= 100 && signals.reference.size() == signals.position.size() &&
                     signals.torque.size() == signals.position.size());
  // which rows obey the law at all; the first fit chose its rows by the torque, the next ones by the law
  Rows const all = usable_rows(signals.position.size());
  Rows rows = inner_rows(signals, all);
  int shift = best_shift(signals, rows);
  Limits limits;
  for (int pass = 0; pass < limit_passes; ++pass) {
    Regression const sofar = regress(signals, {most_lags, shift}, rows);
    limits = find_limits(signals, sofar, all);
    rows = limits.any() ? unclipped_rows(signals, sofar, limits, all) : all;
    if (pass == 0) shift = best_shift(signals, rows);
    if (!limits.any()) break;
  }

  // the law
  Regression fit = best_lags(signals, shift, rows);
  ControllerFit result;
  result.integral_z = fit.coefficients[fit.columns.integral()] / fit.errors[fit.columns.integral()];
  if (!(std::abs(result.integral_z) > z_coefficient)) {
    fit.columns.has_integral = false;
    fit = regress(signals, fit.columns, rows);
  }
  result.law = law_of(fit);
  result.law.least = limits.least;
  result.law.most = limits.most;

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
    // the parameters of the law took their share of the energy
    result.noise.innovation *= std / result.noise.std;
    result.noise.std = std;
  }
  result.drift_per_s = fit.coefficients[fit.columns.drift()];
  result.drift_z = result.drift_per_s / fit.errors[fit.columns.drift()];
  result.lags = fit.columns.lags;
  result.rows = static_cast<Eigen::Index>(rows.size());
  result.clipped_rows = static_cast<Eigen::Index>(all.size() - rows.size());
  result.remark = in_words(result);
  return result;
}

}  // namespace torquescope
