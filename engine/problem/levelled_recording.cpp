#include "engine/problem/levelled_recording.hpp"

#include <algorithm>

#include "kernels/sample_tiles.hpp"

namespace torquescope {
namespace {

using Rows = std::vector<Eigen::Index>;

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

// the rows of each combination of values of these columns; empty when there are too many
std::vector<Rows> rows_by_level(Eigen::MatrixXd const& phi, std::vector<std::size_t> const& columns) {
  std::vector<Rows> levels;
  auto const equal = [&](Eigen::Index a, Eigen::Index b) {
    return std::all_of(columns.begin(), columns.end(), [&](std::size_t c) {
      return phi(a, static_cast<Eigen::Index>(c)) == phi(b, static_cast<Eigen::Index>(c));
    });
  };
  for (Eigen::Index t = 0; t < phi.rows(); ++t) {
    auto const level = std::find_if(levels.begin(), levels.end(), [&](Rows const& rows) { return equal(rows[0], t); });
    if (level != levels.end()) {
      level->push_back(t);
    } else if (levels.size() == most_runs) {
      return {};
    } else {
      levels.push_back({t});
    }
  }
  return levels;
}

// rows of all given columns as tiles
kernels::AlignedDoubles packed(Eigen::MatrixXd const& phi, Eigen::VectorXd const& tau,
                               std::vector<std::size_t> const& columns, Rows const& rows) {
  std::size_t const tile_size = (columns.size() + 1) * kernels::tile_samples;
  kernels::AlignedDoubles tiles(kernels::packed_size(rows.size(), columns.size()));
  for (std::size_t i = 0; i < rows.size(); ++i) {
    double* const place = tiles.data() + i / kernels::tile_samples * tile_size + i % kernels::tile_samples;
    for (std::size_t r = 0; r < columns.size(); ++r)
      place[r * kernels::tile_samples] = phi(rows[i], static_cast<Eigen::Index>(columns[r]));
    place[columns.size() * kernels::tile_samples] = tau[rows[i]];
  }
  return tiles;
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
  auto const levels = rows_by_level(phi, recording.constant_column_);
  if (levels.empty()) return {};

  Rows whole, rest;
  for (Rows const& rows : levels) {
    auto const end =
        rows.begin() + static_cast<std::ptrdiff_t>(rows.size() / kernels::tile_samples * kernels::tile_samples);
    whole.insert(whole.end(), rows.begin(), end);
    rest.insert(rest.end(), end, rows.end());
    recording.run_end_.push_back(whole.size() / kernels::tile_samples);
    for (auto const column : recording.constant_column_)
      recording.level_.push_back(phi(rows[0], static_cast<Eigen::Index>(column)));
  }
  recording.varying_ = packed(phi, tau, recording.varying_column_, whole);
  recording.rest_ = packed(phi, tau, every_column, rest);
  recording.rest_samples_ = rest.size();
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
