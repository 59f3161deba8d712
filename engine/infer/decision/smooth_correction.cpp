#include "engine/infer/decision/smooth_correction.hpp"

#include <cmath>
#include <functional>
#include <utility>

#include "engine/fit/statistics/hat_functions.hpp"
#include "engine/infer/decision/memory_columns.hpp"

namespace torquescope {
namespace {

constexpr Eigen::Index knots = 12;

// a signal of the effects' rate at the rows of all strips
Eigen::VectorXd at_rows(FittedStrips const& fitted, std::function<Eigen::VectorXd const&(Strip const&)> const& signal) {
  Eigen::VectorXd all(fitted.on().rows());
  Eigen::Index first = 0;
  for (auto const& strip : fitted.strips()) {
    Eigen::VectorXd const rows = strip.filters->effects->pick(signal(strip))(strip.rows);
    all.segment(first, rows.size()) = rows;
    first += rows.size();
  }
  return all;
}

Eigen::MatrixXd weighed(FittedStrips const& fitted, Eigen::MatrixXd columns) {
  Eigen::Index first = 0;
  for (auto const& strip : fitted.strips()) {
    auto const rows = static_cast<Eigen::Index>(strip.rows.size());
    if (strip.row_weight.size() > 0)
      columns.middleRows(first, rows) = strip.row_weight.asDiagonal() * columns.middleRows(first, rows);
    first += rows;
  }
  return columns;
}

struct RowRange {
  Eigen::Index first = 0, count = 0;
};

// all rows; and those of each recording, where there are several: what one has and the others have not
std::vector<RowRange> where_to_ask(FittedStrips const& fitted) {
  std::vector<RowRange> ranges{{0, fitted.on().rows()}};
  if (fitted.strips().size() < 2) return ranges;
  Eigen::Index first = 0;
  for (auto const& strip : fitted.strips()) {
    ranges.push_back({first, static_cast<Eigen::Index>(strip.rows.size())});
    first += ranges.back().count;
  }
  return ranges;
}

using AxisColumns = std::pair<SignatureAxis, Eigen::MatrixXd>;

std::vector<Eigen::VectorXd> torque_of_model(FittedStrips const& fitted) {
  std::vector<Eigen::VectorXd> torque;
  for (std::size_t s = 0; s < fitted.strips().size(); ++s)
    torque.push_back(model_torque(fitted.on(), s, fitted.chosen().fit.samples[s], fitted.parameters()));
  return torque;
}

Eigen::MatrixXd memory_on_rows(FittedStrips const& fitted, std::vector<Eigen::VectorXd> const& torque,
                               double frequency_hz) {
  Eigen::MatrixXd all(fitted.on().rows(), 4);
  Eigen::Index first = 0;
  for (std::size_t s = 0; s < fitted.strips().size(); ++s) {
    Eigen::MatrixXd const rows = memory_columns(fitted.strips()[s], torque[s], frequency_hz);
    all.middleRows(first, rows.rows()) = rows;
    first += rows.rows();
  }
  return all;
}

std::vector<AxisColumns> columns_of_axes(FittedStrips const& fitted) {
  Eigen::VectorXd const q = at_rows(
      fitted, [](Strip const& one) -> auto const& { return one.motion.q; });
  Eigen::VectorXd const dq = at_rows(
      fitted, [](Strip const& one) -> auto const& { return one.motion.dq; });
  Eigen::VectorXd const ddq = at_rows(
      fitted, [](Strip const& one) -> auto const& { return one.motion.ddq; });
  Eigen::VectorXd const time = at_rows(
      fitted, [](Strip const& one) -> auto const& { return one.motion.time_s; });
  Eigen::VectorXd const side = at_rows(
      fitted, [](Strip const& one) -> auto const& { return one.direction; });
  Eigen::MatrixXd const places = hats(q, knots);
  std::vector<AxisColumns> axes{{SignatureAxis::position, places},
                                {SignatureAxis::position, side.asDiagonal() * places},
                                {SignatureAxis::velocity, hats(dq, knots)},
                                {SignatureAxis::acceleration, hats(ddq, knots)},
                                {SignatureAxis::time, hats(time, knots)}};
  for (auto& [axis, columns] : axes) columns = weighed(fitted, std::move(columns));
  auto const torque = torque_of_model(fitted);
  for (double const frequency_hz : memory_frequencies(fitted.strips()))
    axes.emplace_back(SignatureAxis::frequency, memory_on_rows(fitted, torque, frequency_hz));
  return axes;
}

Eigen::MatrixXd only_in(RowRange const& range, Eigen::MatrixXd const& columns) {
  Eigen::MatrixXd of = Eigen::MatrixXd::Zero(columns.rows(), columns.cols());
  of.middleRows(range.first, range.count) = columns.middleRows(range.first, range.count);
  return of;
}

}  // namespace

SmoothCorrections smooth_corrections(FittedStrips const& fitted, Score const& score) {
  std::vector<AxisColumns> const axes = columns_of_axes(fitted);
  std::vector<RowRange> const ranges = where_to_ask(fitted);
  auto const n = static_cast<Eigen::Index>(axes.size() * ranges.size());
  SmoothCorrections all{{}, Eigen::VectorXd(n), Eigen::VectorXd(n)};
  Eigen::VectorXd const residual = score.signals().col(0);
  for (auto const& range : ranges)
    for (auto const& [axis, columns] : axes) {
      OrthonormalGroup const group = orthonormal_group(
          only_in(range, columns), score.basis(), std::vector<bool>(static_cast<std::size_t>(columns.cols()), false));
      auto const at = static_cast<Eigen::Index>(all.axes.size());
      all.axes.push_back(axis);
      all.gains[at] = score.gain(group, 0);
      all.rms[at] = std::sqrt((group.q.transpose() * residual).squaredNorm() / static_cast<double>(residual.size()));
    }
  return all;
}

}  // namespace torquescope
