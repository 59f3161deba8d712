#include "science/projection/shape_race.hpp"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "support/optimise.hpp"

namespace torquescope::test {
namespace {

constexpr std::uint64_t search_seed = 2014;

std::vector<double> shape_from(std::vector<ParameterRange> const& ranges, std::span<double const> unit, std::size_t n) {
  std::vector<double> shape(n);
  for (std::size_t k = 0; k < n; ++k) shape[k] = from_unit(ranges[k], unit[k]);
  return shape;
}

struct GridEnergies {
  ShapeGrid grid;
  std::vector<double> energy;      // of every point
  std::vector<std::size_t> order;  // best first
};

GridEnergies grid_energies(PlantedMismatch const& planted) {
  ProjectedEnergy const projected(planted);
  GridEnergies result{shape_grid(*planted.effect, planted.columns->scales()), {}, {}};
  for (std::size_t i = 0; i < result.grid.size(); ++i) result.energy.push_back(projected.at(result.grid.point(i)));
  result.order.resize(result.energy.size());
  std::iota(result.order.begin(), result.order.end(), std::size_t{0});
  std::stable_sort(result.order.begin(), result.order.end(),
                   [&](auto a, auto b) { return result.energy[a] < result.energy[b]; });
  return result;
}

EffectScan scan_at(PlantedMismatch const& planted, ShapeGrid const& grid, std::size_t point) {
  EffectScan scan;
  scan.effect = planted.effect;
  scan.is_testable = true;
  scan.grid = grid;
  scan.best_point = point;
  scan.shape = grid.point(point);
  return scan;
}

std::size_t nearest_point(ShapeGrid const& grid, std::vector<double> const& shape) {
  std::size_t nearest = 0;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < grid.size(); ++i) {
    auto const point = grid.point(i);
    double distance = 0.0;
    for (std::size_t k = 0; k < shape.size(); ++k)
      distance += std::abs(to_unit(grid.ranges[k], point[k]) - to_unit(grid.ranges[k], shape[k]));
    if (distance >= least) continue;
    least = distance;
    nearest = i;
  }
  return nearest;
}

}  // namespace

ProjectedEnergy::ProjectedEnergy(PlantedMismatch const& planted)
    : planted_(planted),
      ranges_(planted.effect->shape_bounds(planted.columns->scales())),
      bounds_(testing::cube(ranges_.size(), 0.0, 1.0)) {
  Eigen::MatrixXd const& known = planted.columns->nuisance();
  whole_ = (planted.mismatch - known * (known.transpose() * planted.mismatch)).squaredNorm();
}

double ProjectedEnergy::left_by(double gain) const {
  return (whole_ - gain) / static_cast<double>(planted_.mismatch.size());
}

double ProjectedEnergy::at(std::vector<double> const& shape) const {
  OrthonormalGroup const group = planted_.columns->group(*planted_.effect, shape);
  return left_by(bounded_gain(group, group.q.transpose() * planted_.mismatch).gain);
}

void ProjectedEnergy::evaluate(MatrixView<double const> candidates, std::span<double> fitness, Workspace&) const {
  for (std::size_t i = 0; i < candidates.rows(); ++i)
    fitness[i] = at(shape_from(ranges_, candidates.row(i), ranges_.size()));
}

FullEnergy::FullEnergy(PlantedMismatch const& planted)
    : planted_(planted), ranges_(planted.effect->shape_bounds(planted.columns->scales())) {
  for (auto const& range : linear_box(*planted.columns, *planted.effect)) ranges_.push_back(range);
  for (auto const& range : baseline_box(planted)) ranges_.push_back(range);
  bounds_ = testing::cube(ranges_.size(), 0.0, 1.0);
}

void FullEnergy::evaluate(MatrixView<double const> candidates, std::span<double> fitness, Workspace&) const {
  Eigen::MatrixXd const& model = planted_.columns->model_columns();
  std::size_t const n_shape = planted_.effect->n_shape();
  auto const n_linear = static_cast<Eigen::Index>(planted_.effect->n_linear());
  for (std::size_t i = 0; i < candidates.rows(); ++i) {
    std::vector<double> const values = shape_from(ranges_, candidates.row(i), ranges_.size());
    Eigen::Map<Eigen::VectorXd const> const linear(values.data() + n_shape, n_linear);
    Eigen::Map<Eigen::VectorXd const> const shifts(values.data() + n_shape + n_linear, model.cols());
    Eigen::MatrixXd const columns = planted_.columns->columns(*planted_.effect, {values.data(), n_shape});
    fitness[i] = (planted_.mismatch - model * shifts - columns * linear).squaredNorm() /
                 static_cast<double>(planted_.mismatch.size());
  }
}

std::vector<double> FullEnergy::best_at(std::vector<double> const& shape) const {
  OrthonormalGroup const group = planted_.columns->group(*planted_.effect, shape);
  Eigen::VectorXd const linear = bounded_gain(group, group.q.transpose() * planted_.mismatch).parameters;
  Eigen::VectorXd const rest = planted_.mismatch - planted_.columns->columns(*planted_.effect, shape) * linear;
  Eigen::VectorXd const shifts = planted_.columns->model_columns().colPivHouseholderQr().solve(rest);
  std::vector<double> values = shape;
  values.insert(values.end(), linear.begin(), linear.end());
  values.insert(values.end(), shifts.begin(), shifts.end());
  for (std::size_t k = 0; k < values.size(); ++k) values[k] = to_unit(ranges_[k], values[k]);
  return values;
}

RaceEnd race(std::string const& optimiser, std::int64_t members, Objective const& objective, double target,
             std::int64_t most_evaluations, RandomKey key) {
  auto const search = testing::make_optimiser(optimiser, objective.bounds(), key, {{"population", members}});
  Workspace workspace;
  RaceEnd end{0, false, std::numeric_limits<double>::infinity()};
  while (end.evaluations < most_evaluations) {
    testing::Batch batch = testing::ask(*search);
    objective.evaluate(batch.rows(), batch.fitness, workspace);
    for (double const fitness : batch.fitness) {
      ++end.evaluations;
      end.best = std::min(end.best, fitness);
      end.reached = end.best <= target;
      if (end.reached || end.evaluations == most_evaluations) return end;
    }
    search->tell(batch.rows(), batch.fitness);
  }
  return end;
}

RaceEnd race_as_diagnosed(PlantedMismatch const& planted, ShapeSearch const& search, double target) {
  ProjectedEnergy const projected(planted);
  GridEnergies const scanned = grid_energies(planted);
  RefinedEffect const refined = refine_shape(*planted.columns, scan_at(planted, scanned.grid, scanned.order.front()),
                                             planted.mismatch, search, 1);
  auto const points = static_cast<std::int64_t>(scanned.grid.size());
  for (auto const& [evaluations, gain] : refined.improvements)
    if (double const energy = projected.left_by(gain); energy <= target) return {points + evaluations, true, energy};
  return {points + refined.evaluations, false, projected.left_by(refined.improvements.back().gain)};
}

BestKnown best_known(PlantedMismatch const& planted) {
  constexpr std::size_t n_started = 3;
  constexpr int generations = 30;
  ProjectedEnergy const projected(planted);
  GridEnergies const scanned = grid_energies(planted);
  std::vector<std::size_t> starts{nearest_point(scanned.grid, planted.shape)};
  for (std::size_t i = 0; i < std::min(n_started, scanned.order.size()); ++i) starts.push_back(scanned.order[i]);

  BestKnown best{planted.shape, projected.at(planted.shape)};
  ShapeSearch search = shape_search("de", search_seed);
  search.generations = generations;
  for (std::size_t const start : starts) {
    RefinedEffect const refined =
        refine_shape(*planted.columns, scan_at(planted, scanned.grid, start), planted.mismatch, search, 1);
    double const energy = projected.left_by(refined.improvements.back().gain);
    if (energy < best.energy) best = {refined.shape, energy};
  }
  return best;
}

}  // namespace torquescope::test
