#include "engine/infer/locate/map_axes.hpp"

#include <algorithm>
#include <cmath>

#include "engine/base/contract.hpp"

namespace torquescope {
namespace {

std::vector<double> equal_widths(double from, double to, int cells) {
  std::vector<double> edges;
  for (int i = 0; i < cells; ++i) edges.push_back(from + (to - from) * static_cast<double>(i) / cells);
  edges.push_back(to);
  return edges;
}

// zero is an edge, and the two sides have nearly the same width of cell
std::vector<double> about_zero(double from, double to) {
  if (from >= 0.0 || to <= 0.0) return equal_widths(from, to, n_map_cells);
  long const share = std::lround(n_map_cells * from / (from - to));
  int const below = static_cast<int>(std::clamp<long>(share, 1, n_map_cells - 1));
  std::vector<double> edges = equal_widths(from, 0.0, below);
  std::vector<double> const above = equal_widths(0.0, to, n_map_cells - below);
  edges.insert(edges.end(), above.begin() + 1, above.end());
  return edges;
}

std::vector<double> equally_populated(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  std::vector<double> edges;
  for (std::size_t i = 0; i < n_map_cells; ++i) edges.push_back(values[values.size() * i / n_map_cells]);
  edges.push_back(values.back());
  return edges;
}

}  // namespace

CellReading shown_reading(SignatureAxis axis) {
  switch (axis) {
    case SignatureAxis::load:
    case SignatureAxis::since_velocity_reversal:
      return CellReading::along_motion;
    case SignatureAxis::since_torque_reversal:
      return CellReading::along_torque;
    default:
      return CellReading::torque;
  }
}

std::string axis_unit(SignatureAxis axis, JointKind joint) {
  std::string length = joint == JointKind::revolute ? "rad" : "m";
  switch (axis) {
    case SignatureAxis::velocity:
      return length + "/s";
    case SignatureAxis::acceleration:
      return length + "/s2";
    case SignatureAxis::load:
      return joint == JointKind::revolute ? "N m" : "N";
    case SignatureAxis::time:
      return "s";
    case SignatureAxis::frequency:
      return "Hz";
    case SignatureAxis::order:
      return "1/" + length;
    case SignatureAxis::position:
    case SignatureAxis::since_velocity_reversal:
    case SignatureAxis::since_torque_reversal:
      break;
  }
  return length;
}

Eigen::VectorXd values_on(SignatureAxis axis, MotionAxes const& axes) {
  switch (axis) {
    case SignatureAxis::velocity:
      return axes.dq;
    case SignatureAxis::since_velocity_reversal:
      return axes.since_velocity_reversal;
    case SignatureAxis::since_torque_reversal:
      return axes.since_torque_reversal;
    case SignatureAxis::load:
      return (axes.dq.array() < 0.0).select(-axes.load_torque, axes.load_torque);
    case SignatureAxis::position:
      return axes.q;
    case SignatureAxis::acceleration:
      return axes.ddq;
    case SignatureAxis::time:
      return axes.time_s;
    case SignatureAxis::order:
    case SignatureAxis::frequency:
      break;
  }
  TORQUESCOPE_EXPECT(!is_spectrum(axis));
  return {};
}

std::vector<double> cell_edges(SignatureAxis axis, Eigen::VectorXd const& values) {
  std::vector<double> finite;
  for (double value : values)
    if (std::isfinite(value)) finite.push_back(value);
  if (finite.empty()) return std::vector<double>(n_map_cells + 1, 0.0);
  auto const [least, most] = std::minmax_element(finite.begin(), finite.end());
  switch (axis) {
    case SignatureAxis::velocity:
    case SignatureAxis::load:
    case SignatureAxis::acceleration:
      return about_zero(*least, *most);
    case SignatureAxis::since_velocity_reversal:
    case SignatureAxis::since_torque_reversal:
      return equally_populated(std::move(finite));
    default:
      return equal_widths(*least, *most, n_map_cells);
  }
}

std::vector<int> cells_of(Eigen::VectorXd const& values, std::span<double const> edges) {
  auto const last = static_cast<std::ptrdiff_t>(edges.size()) - 2;
  std::vector<int> cells;
  cells.reserve(static_cast<std::size_t>(values.size()));
  for (double value : values) {
    auto const cell = std::upper_bound(edges.begin(), edges.end(), value) - edges.begin() - 1;
    cells.push_back(std::isfinite(value) ? static_cast<int>(std::clamp<std::ptrdiff_t>(cell, 0, last)) : -1);
  }
  return cells;
}

}  // namespace torquescope
