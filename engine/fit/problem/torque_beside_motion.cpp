#include "engine/fit/problem/torque_beside_motion.hpp"

#include <cmath>
#include <utility>

#include "engine/base/dense_solvers.hpp"
#include "engine/data/filter_checks.hpp"
#include "engine/fit/statistics/hat_functions.hpp"

namespace torquescope {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr Index most_rows_beside = 20000;  // a check must not cost a fit
constexpr Index knots = 12;                // per axis: effects of friction and weight bend less often than that
constexpr Index fewest_rows_a_column = 5;
constexpr double dependent = 1e-7;  // of the largest pivot: hats of every axis sum to one

std::vector<Index> sampled_rows(Motion const& motion, FilterOptions const& options, ParallelFilter const& filter) {
  auto const out = left_out_samples(motion, parallel_cutoff_of(options));
  VectorXd is_out(motion.q.size());
  for (Index k = 0; k < is_out.size(); ++k) is_out[k] = !out.empty() && out[static_cast<std::size_t>(k)] ? 1.0 : 0.0;
  VectorXd const picked = filter.pick(is_out);
  Index const stride = (picked.size() + most_rows_beside - 1) / most_rows_beside;
  std::vector<Index> rows;
  for (Index i = 0; i < picked.size(); i += std::max<Index>(stride, 1))
    if (picked[i] == 0.0) rows.push_back(i);
  return rows;
}

VectorXd unit_rms(VectorXd signal) {
  double const rms = std::sqrt(signal.squaredNorm() / static_cast<double>(std::max<Index>(signal.size(), 1)));
  return rms > 0.0 ? VectorXd(signal / rms) : signal;
}

}  // namespace

double energy_within(VectorXd const& signal, MatrixXd const& columns) {
  if (columns.cols() == 0) return 0.0;
  return (PivotedQr(columns, dependent).basis().transpose() * signal).squaredNorm();
}

VectorXd TorqueBesideMotion::filtered(VectorXd const& signal) const { return filter_->apply(signal)(rows_); }

MatrixXd TorqueBesideMotion::left_of(MatrixXd columns) const {
  columns -= basis_ * (basis_.transpose() * columns).eval();
  return columns;
}

void TorqueBesideMotion::take(VectorXd const& torque) {
  VectorXd const seen = filtered(torque);
  left_ = left_of(seen);
  torque_rms_ = std::sqrt(seen.squaredNorm() / static_cast<double>(seen.size()));
}

TorqueBesideMotion TorqueBesideMotion::with(VectorXd const& torque) const {
  TorqueBesideMotion other = *this;
  other.take(torque);
  return other;
}

double TorqueBesideMotion::error() const {
  double const rms = std::sqrt(left_.squaredNorm() / static_cast<double>(std::max<Index>(left_.size(), 1)));
  return torque_rms_ > 0.0 ? rms / torque_rms_ : 0.0;
}

std::optional<TorqueBesideMotion> TorqueBesideMotion::of(Recording const& recording, FilterOptions const& options,
                                                         Regressor const& regressor, Section const& filter) {
  Motion const motion = differentiate(recording, options, filter);
  return of(motion, regressor.columns(motion), options, filter);
}

std::optional<TorqueBesideMotion> TorqueBesideMotion::of(Motion const& motion, MatrixXd const& model_columns,
                                                         FilterOptions const& options, Section const& filter) {
  auto parallel = std::make_shared<ParallelFilter const>(options, motion.rate_hz, motion.q.size(), filter);
  auto rows = sampled_rows(motion, options, *parallel);
  if (rows.empty()) return std::nullopt;
  TorqueBesideMotion beside(std::move(parallel), std::move(rows));
  auto const picked = [&](VectorXd const& signal) { return VectorXd(beside.filter_->pick(signal)(beside.rows_)); };
  VectorXd const q = picked(motion.q), dq = picked(motion.dq), ddq = picked(motion.ddq);
  VectorXd const direction = beside.filtered(motion.dq.array().sign());
  VectorXd const loaded = beside.filtered(motion.dq.array().sign() * motion.ddq.array().abs());

  MatrixXd const model = beside.filter_->apply_columns(model_columns)(beside.rows_, Eigen::all);
  MatrixXd const along = hats(q, knots);
  MatrixXd const friction_along = along.array().colwise() * direction.array();
  MatrixXd columns = side_by_side({model, along, hats(dq, knots), friction_along, direction, loaded});
  for (Index k = 0; k < columns.cols(); ++k) columns.col(k) = unit_rms(columns.col(k));
  if (q.size() < fewest_rows_a_column * columns.cols()) return std::nullopt;

  beside.basis_ = PivotedQr(columns, dependent).basis();
  beside.take(motion.torque);
  beside.time_s_ = picked(motion.time_s);
  beside.scaled_ = side_by_side({direction, unit_rms(q.array() - q.mean()), unit_rms(dq), unit_rms(ddq)});
  return beside;
}

}  // namespace torquescope
