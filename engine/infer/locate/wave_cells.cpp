#include "engine/infer/locate/wave_cells.hpp"

#include <algorithm>
#include <cmath>

#include "engine/infer/locate/map_axes.hpp"
#include "engine/infer/verdict/diagnosis.hpp"

namespace torquescope {
namespace {

// in distances of two waves
std::vector<double> growing_edges(double from, double growth) {
  std::vector<double> edges{from};
  for (int cell = 0; cell < n_map_cells; ++cell) edges.push_back(std::max(edges.back() + 1.0, edges.back() * growth));
  return edges;
}

}  // namespace

std::vector<double> wave_edges(WaveGrid const& grid) {
  if (grid.last < grid.first) return std::vector<double>(n_map_cells + 1, 0.0);
  double const from = static_cast<double>(grid.first), to = grid.highest / grid.spacing;
  std::vector<double> edges;
  if (to - from <= n_map_cells) {
    for (int i = 0; i <= n_map_cells; ++i) edges.push_back(from + (to - from) * i / n_map_cells);
  } else {
    // the last edge rises with the factor: halve until it is the end of the range
    double low = 1.0, high = to / from;
    for (int round = 0; round < 100; ++round) {
      double const middle = 0.5 * (low + high);
      (growing_edges(from, middle).back() < to ? low : high) = middle;
    }
    edges = growing_edges(from, low);
  }
  for (double& edge : edges) edge *= grid.spacing;
  edges.back() = grid.highest;
  return edges;
}

std::vector<WaveBand> waves_in(WaveGrid const& grid, std::span<double const> edges) {
  // edges that are waves themselves come back from their unit with the last bit changed
  constexpr double rounding = 1e-9;
  auto const first_at = [&](double edge) {
    if (!(grid.spacing > 0.0)) return grid.first;
    auto const wave = static_cast<Eigen::Index>(std::ceil(edge / grid.spacing * (1.0 - rounding)));
    return std::clamp(wave, grid.first, grid.last + 1);
  };
  std::vector<WaveBand> bands;
  for (std::size_t cell = 0; cell + 1 < edges.size(); ++cell)
    bands.push_back({first_at(edges[cell]), first_at(edges[cell + 1]) - 1});
  if (grid.last >= grid.first && grid.spacing * static_cast<double>(grid.last) <= edges.back() * (1.0 + rounding))
    bands.back().last = grid.last;
  return bands;
}

std::vector<WaveBand> third_octaves(WaveGrid const& grid) {
  std::vector<WaveBand> bands;
  double const main_lobe = 2.0 * grid.overlap();
  double from = static_cast<double>(grid.first);
  while (grid.last >= grid.first) {
    double const width = std::max(from * (std::cbrt(2.0) - 1.0), main_lobe);
    bands.push_back({static_cast<Eigen::Index>(std::ceil(from)),
                     std::min(grid.last, static_cast<Eigen::Index>(std::floor(from + width)))});
    if (bands.back().last == grid.last) break;
    from += 0.25 * width;
  }
  return bands;
}

Eigen::MatrixXd wave_amplitudes(WaveGrid const& grid, std::vector<WaveBand> const& bands,
                                Eigen::MatrixXd const& energies) {
  Eigen::MatrixXd amplitudes(energies.rows(), energies.cols());
  double const rows = static_cast<double>(grid.point.size());
  for (Eigen::Index band = 0; band < energies.rows(); ++band) {
    auto const waves = bands[static_cast<std::size_t>(band)].waves();
    if (waves <= 0)
      amplitudes.row(band).setConstant(unknown);
    else
      amplitudes.row(band) =
          (energies.row(band) * (2.0 * grid.overlap() / (static_cast<double>(waves) * rows))).cwiseSqrt();
  }
  return amplitudes;
}

}  // namespace torquescope
