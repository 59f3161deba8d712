#include "engine/fit/problem/levelled_recording.hpp"

#include <algorithm>
#include <cstdint>

#include "kernels/sample_tiles.hpp"

namespace torquescope {
namespace {

constexpr std::size_t most_values = 3;
constexpr std::size_t most_runs = 8;
constexpr std::size_t least_constant = 2;
// at least this many samples, so that what fills no whole tile stays a small share
constexpr Eigen::Index least_samples = 2048;

bool takes_few_values(Eigen::MatrixXd const& phi, Eigen::Index column) {
  std::vector<double> values;
  for (Eigen::Index t = 0; t < phi.rows(); ++t) {
    double const x = phi(t, column);
    if (std::find(values.begin(), values.end(), x) != values.end()) continue;
    if (values.size() == most_values) return false;
    values.push_back(x);
  }
  return true;
}

// which combination of values of these columns every row has
struct Levels {
  std::vector<std::uint8_t> of_row;
  std::vector<Eigen::Index> first_row;  // [level] where it is met first
  std::vector<std::size_t> count;       // [level] rows
};

// empty when there are too many
std::optional<Levels> find_levels(Eigen::MatrixXd const& phi, std::vector<std::size_t> const& columns) {
  Levels levels;
  levels.of_row.resize(static_cast<std::size_t>(phi.rows()));
  auto const equal = [&](Eigen::Index a, Eigen::Index b) {
    return std::all_of(columns.begin(), columns.end(), [&](std::size_t c) {
      return phi(a, static_cast<Eigen::Index>(c)) == phi(b, static_cast<Eigen::Index>(c));
    });
  };
  for (Eigen::Index t = 0; t < phi.rows(); ++t) {
    std::size_t level = 0;
    while (level < levels.first_row.size() && !equal(levels.first_row[level], t)) ++level;
    if (level == most_runs) return {};
    if (level == levels.first_row.size()) {
      levels.first_row.push_back(t);
      levels.count.push_back(0);
    }
    ++levels.count[level];
    levels.of_row[static_cast<std::size_t>(t)] = static_cast<std::uint8_t>(level);
  }
  return levels;
}

// these columns and the torque of row t as sample i of the tiles
void pack_row(Eigen::MatrixXd const& phi, Eigen::VectorXd const& tau, std::vector<std::size_t> const& columns,
              Eigen::Index t, std::size_t i, double* tiles) {
  std::size_t const tile_size = (columns.size() + 1) * kernels::tile_samples;
  double* const place = tiles + i / kernels::tile_samples * tile_size + i % kernels::tile_samples;
  for (std::size_t r = 0; r < columns.size(); ++r)
    place[r * kernels::tile_samples] = phi(t, static_cast<Eigen::Index>(columns[r]));
  place[columns.size() * kernels::tile_samples] = tau[t];
}

}  // namespace

std::optional<LevelledRecording> LevelledRecording::make(Eigen::MatrixXd const& phi, Eigen::VectorXd const& tau) {
  if (phi.rows() < least_samples) return {};
  LevelledRecording recording;
  std::vector<std::size_t> every_column;
  for (Eigen::Index c = 0; c < phi.cols(); ++c) {
    auto const column = static_cast<std::size_t>(c);
    every_column.push_back(column);
    (takes_few_values(phi, c) ? recording.constant_column_ : recording.varying_column_).push_back(column);
  }
  if (recording.constant_column_.size() < least_constant) return {};
  auto const levels = find_levels(phi, recording.constant_column_);
  if (!levels) return {};

  // where the next row of each level goes: whole tiles to its run, what fills none to the rest
  std::vector<std::size_t> next_whole, next_rest, end_whole;
  std::size_t n_whole = 0;
  for (std::size_t level = 0; level < levels->count.size(); ++level) {
    std::size_t const whole = levels->count[level] / kernels::tile_samples * kernels::tile_samples;
    next_whole.push_back(n_whole);
    end_whole.push_back(n_whole += whole);
    next_rest.push_back(recording.rest_samples_);
    recording.rest_samples_ += levels->count[level] - whole;
    recording.run_end_.push_back(n_whole / kernels::tile_samples);
    for (auto const column : recording.constant_column_)
      recording.level_.push_back(phi(levels->first_row[level], static_cast<Eigen::Index>(column)));
  }

  recording.varying_.resize(kernels::packed_size(n_whole, recording.varying_column_.size()));
  recording.rest_.resize(kernels::packed_size(recording.rest_samples_, every_column.size()));
  for (Eigen::Index t = 0; t < phi.rows(); ++t) {
    std::size_t const level = levels->of_row[static_cast<std::size_t>(t)];
    if (next_whole[level] < end_whole[level])
      pack_row(phi, tau, recording.varying_column_, t, next_whole[level]++, recording.varying_.data());
    else
      pack_row(phi, tau, every_column, t, next_rest[level]++, recording.rest_.data());
  }
  return recording;
}

kernels::LevelledTiles LevelledRecording::tiles() const {
  std::size_t const n_columns = constant_column_.size() + varying_column_.size();
  kernels::LevelledTiles tiles;
  tiles.varying = {varying_.data(), run_end_.back() * kernels::tile_samples, varying_column_.size()};
  tiles.rest = {rest_.data(), rest_samples_, n_columns};
  tiles.n_runs = run_end_.size();
  tiles.run_end = run_end_.data();
  tiles.level = level_.data();
  tiles.n_constant = constant_column_.size();
  tiles.constant_column = constant_column_.data();
  tiles.varying_column = varying_column_.data();
  return tiles;
}

}  // namespace torquescope
