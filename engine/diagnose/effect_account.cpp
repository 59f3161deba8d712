#include "engine/diagnose/effect_account.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "engine/fit/statistics/scaled_solution.hpp"
#include "engine/infer/locate/acting_region.hpp"
#include "engine/infer/locate/map_axes.hpp"

namespace torquescope {
namespace {

// the reading of the map: torque that turns with the direction is counted along the motion
Eigen::VectorXd reading_sign(SignatureAxis axis, MismatchRows const& rows) {
  switch (shown_reading(axis)) {
    case CellReading::along_motion:
      return rows.dq.array().sign();
    case CellReading::along_torque:
      return rows.model_torque.array().sign();
    case CellReading::torque:
      break;
  }
  return Eigen::VectorXd::Ones(rows.size());
}

EffectCurve curve_on(SignatureAxis axis, MismatchRows const& rows, Eigen::VectorXd const& torque,
                     Eigen::VectorXd const& left, JointKind joint) {
  EffectCurve curve;
  Eigen::VectorXd const values = values_on(axis, rows);
  std::vector<double> const edges = cell_edges(axis, values);
  std::vector<int> const cells = cells_of(values, edges);
  Eigen::VectorXd const sign = reading_sign(axis, rows);
  std::size_t const n = edges.size() - 1;
  Eigen::MatrixXd const apart = rows.replicates.colwise() - rows.replicate_mean;
  curve.axis = {word(axis), edges.front(), edges.back(), axis_unit(axis, joint)};
  for (std::size_t cell = 0; cell < n; ++cell) {
    double count = 0.0, modelled = 0.0, partial = 0.0;
    Eigen::RowVectorXd replicates = Eigen::RowVectorXd::Zero(apart.cols());
    for (std::size_t k = 0; k < cells.size(); ++k) {
      if (cells[k] != static_cast<int>(cell)) continue;
      auto const row = static_cast<Eigen::Index>(k);
      count += 1.0;
      modelled += sign[row] * torque[row];
      partial += sign[row] * (torque[row] + left[row]);
      replicates += sign[row] * apart.row(row);
    }
    if (count == 0.0) continue;
    curve.at.push_back(0.5 * (edges[cell] + edges[cell + 1]));
    curve.modelled.push_back(modelled / count);
    curve.partial.push_back(partial / count);
    curve.spread.push_back(replicates.norm() / count / std::sqrt(static_cast<double>(apart.cols() - 1)));
  }
  return curve;
}

// the wave an effect is, as an interval of the spectrum's axis
std::optional<AxisInterval> wave_region(ShapedEffect const& shaped, SignatureAxis axis, JointScales const& scales) {
  if (!is_spectrum(axis)) return std::nullopt;
  for (std::size_t k = 0; k < shaped.shape.size(); ++k) {
    auto const& parameter = shaped.effect->parameters()[shaped.effect->n_linear() + k];
    RelativeTo const to = parameter.lower.to;
    if (to != RelativeTo::lowest_order && to != RelativeTo::slowest_frequency && to != RelativeTo::cutoff_frequency)
      continue;
    double const half =
        to == RelativeTo::cutoff_frequency ? 0.25 * shaped.shape[k] : 0.5 * bound_value({1.0, to}, scales);
    return AxisInterval{word(axis), std::max(0.0, shaped.shape[k] - half), shaped.shape[k] + half,
                        axis_unit(axis, scales.joint)};
  }
  // one wave per turn
  return AxisInterval{word(axis), 0.5, 1.5, axis_unit(axis, scales.joint)};
}

}  // namespace

double peak_in(std::vector<AxisInterval> const& places, Eigen::VectorXd const& at, Eigen::VectorXd const& torque) {
  double peak = -1.0;
  for (Eigen::Index k = 0; k < torque.size(); ++k)
    for (auto const& place : places)
      if (at[k] >= place.from && at[k] <= place.to) peak = std::max(peak, std::abs(torque[k]));
  return peak >= 0.0 ? peak : torque.cwiseAbs().maxCoeff();
}

Eigen::VectorXd beside_the_level(Regressor const& regressor, Effect const& effect, Eigen::MatrixXd const& columns,
                                 Eigen::VectorXd torque) {
  if (!effect.is_level_free()) return torque;
  Eigen::MatrixXd levels(torque.size(), 0);
  for (std::size_t k = 0; k < regressor.size(); ++k) {
    auto const& owner = regressor.column_owners()[k];
    bool const is_constant = !owner.needs_position && !owner.needs_velocity && !owner.needs_acceleration &&
                             !regressor.terms()[owner.term]->is_given();
    if (!is_constant && !regressor.terms()[owner.term]->is_dry_friction()) continue;
    levels.conservativeResize(Eigen::NoChange, levels.cols() + 1);
    levels.rightCols(1) = columns.col(static_cast<Eigen::Index>(k));
  }
  if (levels.cols() == 0) return torque;
  return torque - levels * solve_scaled(levels, torque);
}

EffectAccount account_of(EffectOnRecording const& on) {
  SignatureAxis const axis = on.shaped.effect->signature().front();
  JointKind const joint = on.scales.joint;
  EffectAccount account;
  account.rms = std::sqrt(on.beside.squaredNorm() / static_cast<double>(on.beside.size()));
  if (auto const wave = wave_region(on.shaped, axis, on.scales)) {
    account.region = *wave;
    account.places = {*wave};
    account.peak = on.beside.cwiseAbs().maxCoeff();
  } else {
    ActingRegion const found = acting_region(values_on(axis, on.axes), on.acting.array().square().matrix());
    auto const on_axis = [&](std::pair<double, double> const& interval) {
      return AxisInterval{word(axis), interval.first, interval.second, axis_unit(axis, joint)};
    };
    account.region = on_axis(found.interval);
    for (auto const& interval : found.intervals) account.places.push_back(on_axis(interval));
    account.peak = peak_in(account.places, values_on(axis, on.rows), on.beside);
  }
  SignatureAxis const drawn = is_spectrum(axis) ? SignatureAxis::position : axis;
  account.curve = curve_on(drawn, on.rows, on.whole, on.rows.residual - on.rows.replicate_mean, joint);
  return account;
}

}  // namespace torquescope
