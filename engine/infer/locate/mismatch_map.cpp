#include "engine/infer/locate/mismatch_map.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "engine/base/contract.hpp"
#include "engine/fit/statistics/replicate_null.hpp"
#include "engine/infer/locate/cell_means.hpp"
#include "engine/infer/locate/map_axes.hpp"
#include "engine/infer/locate/map_regions.hpp"
#include "engine/infer/locate/wave_cells.hpp"
#include "engine/infer/locate/wave_spectrum.hpp"

namespace torquescope {
namespace {

// what depends on these comes even and odd in the direction of motion: drift of a sensor, of friction
bool read_both_ways(SignatureAxis axis) { return axis == SignatureAxis::position || axis == SignatureAxis::time; }

// the recording's energy beyond the replicates' average; columns: recording, replicates
double excess(Eigen::RowVectorXd const& energies) { return energies[0] - energies.tail(energies.size() - 1).mean(); }

double share_of(double part, double whole) { return whole > 0.0 ? std::clamp(part / whole, 0.0, 1.0) : 0.0; }

void set_share(MapAxis& axis, Eigen::RowVectorXd const& energies, double residual_energy) {
  std::vector<double> const replicates(energies.data() + 1, energies.data() + energies.size());
  axis.energy_share = share_of(excess(energies), residual_energy);
  axis.p = empirical_p(energies[0], replicates);
}

// shown: cells x (1 + M)
std::vector<MapCell> make_cells(std::span<double const> edges, Eigen::Ref<Eigen::VectorXd const> const& samples,
                                Eigen::MatrixXd const& shown, CellScores const& scores) {
  std::vector<MapCell> cells(edges.size() - 1);
  Eigen::Index const m = shown.cols() - 1;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    auto const cell = static_cast<Eigen::Index>(i);
    auto const replicates = shown.row(cell).tail(m);
    double const mean = replicates.mean();
    double const variance = (replicates.array() - mean).square().sum() / static_cast<double>(m - 1);
    cells[i] = {edges[i],
                edges[i + 1],
                static_cast<Eigen::Index>(samples[cell]),
                shown(cell, 0),
                mean,
                std::sqrt(variance),
                scores.recording[cell]};
  }
  return cells;
}

std::vector<double> edges_of(MapAxis const& axis) {
  std::vector<double> edges;
  for (MapCell const& cell : axis.cells) edges.push_back(cell.from);
  edges.push_back(axis.cells.back().to);
  return edges;
}

AxisInterval interval(MapAxis const& axis, CellRun const& run) {
  return {axis.axis, axis.cells[static_cast<std::size_t>(run.first)].from,
          axis.cells[static_cast<std::size_t>(run.last)].to, axis.unit};
}

// sum over the cells of a run, columns kept
Eigen::RowVectorXd run_sum(Eigen::MatrixXd const& per_cell, CellRun const& run) {
  return per_cell.middleRows(run.first, run.last - run.first + 1).colwise().sum();
}

// ----- axes with means

CellSums axis_sums(SignatureAxis axis, MismatchRows const& rows, std::span<double const> edges, int threads) {
  auto const cells = cells_of(values_on(axis, rows), edges);
  return sum_in_cells(rows, cells, static_cast<int>(edges.size()) - 1, shown_reading(axis), threads);
}

MapAxis mean_axis(SignatureAxis which, MismatchRows const& rows, JointScales const& scales, int threads) {
  MapAxis axis{word(which), axis_unit(which, scales.joint)};
  auto const edges = cell_edges(which, values_on(which, rows));
  CellSums const sums = axis_sums(which, rows, edges, threads);
  Eigen::MatrixXd const means = cell_means(sums, shown_reading(which));
  std::vector<CellScores> scores{score_cells(means)};
  axis.cells = make_cells(edges, sums.rows(), means, scores.front());

  double const residual_energy = rows.residual.squaredNorm();
  Eigen::MatrixXd const energies =
      read_both_ways(which) ? two_sided_energies(sums) : cell_energies(sums, shown_reading(which));
  set_share(axis, energies.colwise().sum(), residual_energy);

  if (read_both_ways(which)) scores.push_back(score_cells(cell_means(sums, CellReading::along_motion)));
  for (CellRun const& run : unusual_runs(scores, edges, Tail::both)) {
    double const own_energy = run_sum(sums.energy, run)[0];
    MismatchRegion region{interval(axis, run)};
    region.time_share = run_sum(sums.rows(), run)[0] / static_cast<double>(rows.size());
    region.energy_share = share_of(own_energy, residual_energy);
    if (own_energy > 0.0) region.repeatable_share = share_of(excess(run_sum(energies, run)), own_energy);
    axis.regions.push_back(region);
  }
  return axis;
}

// ----- spectra

Eigen::VectorXd wave_counts(std::vector<WaveBand> const& bands) {
  Eigen::VectorXd counts(static_cast<Eigen::Index>(bands.size()));
  for (std::size_t i = 0; i < bands.size(); ++i)
    counts[static_cast<Eigen::Index>(i)] = static_cast<double>(std::max<Eigen::Index>(0, bands[i].waves()));
  return counts;
}

WaveGrid axis_waves(SignatureAxis axis, MismatchRows const& rows, double highest) {
  return axis == SignatureAxis::order ? position_waves(rows, highest) : time_waves(rows, highest);
}

// log power; NaN without waves
CellScores score_amplitudes(Eigen::MatrixXd amplitudes) {
  constexpr double least = std::numeric_limits<double>::min();
  for (double& value : amplitudes.reshaped())
    if (!std::isnan(value)) value = 2.0 * std::log(std::max(value, least));
  return score_cells(amplitudes);
}

// energies: windows x (1 + M); result: of each column the largest excess over the other replicates' mean
Eigen::RowVectorXd strongest_window(Eigen::MatrixXd const& energies) {
  Eigen::Index const n_replicates = energies.cols() - 1;
  double const m = static_cast<double>(n_replicates);
  Eigen::MatrixXd beyond = energies.colwise() - energies.rightCols(n_replicates).rowwise().mean();
  beyond.rightCols(n_replicates) *= m / (m - 1.0);  // a replicate against the others
  return beyond.colwise().maxCoeff();
}

// of the torque itself: any effect of the motion leaves most where most of the motion is
void set_torque_shares(std::vector<MapCell>& cells, MismatchRows const& rows, WaveGrid const& grid,
                       std::vector<WaveBand> const& bands) {
  MismatchRows alone;
  alone.residual = rows.torque.array() - rows.torque.mean();
  alone.replicate_mean = Eigen::VectorXd::Zero(rows.size());
  alone.replicates.resize(rows.size(), 0);
  Eigen::VectorXd const energy = band_energies(alone, grid, bands, 1);
  double const whole = energy.sum();
  for (std::size_t i = 0; i < cells.size() && whole > 0.0; ++i)
    cells[i].torque_share = energy[static_cast<Eigen::Index>(i)] / whole;
}

MapAxis spectrum_axis(SignatureAxis which, MismatchRows const& rows, JointScales const& scales, int threads) {
  MapAxis axis{word(which), axis_unit(which, scales.joint), true};
  double const highest = bound_value(
      {1.0, which == SignatureAxis::order ? RelativeTo::highest_order : RelativeTo::cutoff_frequency}, scales);
  WaveGrid const grid = axis_waves(which, rows, highest);
  auto const edges = wave_edges(grid);
  auto const cells = waves_in(grid, edges);
  auto const windows = third_octaves(grid);
  auto bands = cells;
  bands.insert(bands.end(), windows.begin(), windows.end());
  Eigen::MatrixXd const all = band_energies(rows, grid, bands, threads);
  Eigen::MatrixXd const energies = all.topRows(n_map_cells);
  Eigen::MatrixXd const amplitudes = wave_amplitudes(grid, cells, energies);
  std::vector<CellScores> const scores{score_amplitudes(amplitudes)};
  axis.cells = make_cells(edges, wave_counts(cells), amplitudes, scores.front());
  set_torque_shares(axis.cells, rows, grid, cells);

  double const residual_energy = rows.residual.squaredNorm();
  if (windows.empty()) return axis;
  set_share(axis, strongest_window(all.bottomRows(static_cast<Eigen::Index>(windows.size()))), residual_energy);
  for (CellRun const& run : unusual_runs(scores, edges, Tail::upper)) {
    Eigen::RowVectorXd const energy = run_sum(energies, run);
    MismatchRegion region{interval(axis, run)};
    region.energy_share = share_of(energy[0], residual_energy);
    region.repeatable_share = share_of(excess(energy), energy[0]);
    axis.regions.push_back(region);
  }
  return axis;
}

// ----- after

void fill_after(MapAxis& axis, Eigen::MatrixXd const& shown, CellScores const& scores) {
  for (std::size_t i = 0; i < axis.cells.size(); ++i) {
    axis.cells[i].after_z = scores.recording[static_cast<Eigen::Index>(i)];
    axis.cells[i].after_residual = shown(static_cast<Eigen::Index>(i), 0);
  }
}

}  // namespace

std::vector<MapAxis> mismatch_map(MismatchRows const& rows, JointScales const& scales, int threads) {
  TORQUESCOPE_EXPECT(rows.n_replicates() >= 8 && rows.size() > 0);
  std::vector<MapAxis> map;
  for (SignatureAxis axis : map_axes)
    map.push_back(is_spectrum(axis) ? spectrum_axis(axis, rows, scales, threads)
                                    : mean_axis(axis, rows, scales, threads));
  return map;
}

void add_after(std::vector<MapAxis>& map, MismatchRows const& after, int threads) {
  TORQUESCOPE_EXPECT(map.size() == map_axes.size() && after.n_replicates() >= 8);
  for (std::size_t i = 0; i < map.size(); ++i) {
    SignatureAxis const which = map_axes[i];
    auto const edges = edges_of(map[i]);
    if (is_spectrum(which)) {
      WaveGrid const grid = axis_waves(which, after, edges.back());
      auto const cells = waves_in(grid, edges);
      Eigen::MatrixXd const amplitudes = wave_amplitudes(grid, cells, band_energies(after, grid, cells, threads));
      fill_after(map[i], amplitudes, score_amplitudes(amplitudes));
    } else {
      Eigen::MatrixXd const means = cell_means(axis_sums(which, after, edges, threads), shown_reading(which));
      fill_after(map[i], means, score_cells(means));
    }
  }
}

}  // namespace torquescope
