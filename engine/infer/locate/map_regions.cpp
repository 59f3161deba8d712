#include "engine/infer/locate/map_regions.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/base/contract.hpp"
#include "engine/fit/statistics/replicate_null.hpp"
#include "engine/infer/verdict/diagnosis.hpp"

namespace torquescope {
namespace {

constexpr double level = 0.05;

struct Thresholds {
  double seed = std::numeric_limits<double>::infinity();
  double growth = std::numeric_limits<double>::infinity();
};

double extremity(double z, Tail tail) { return tail == Tail::both ? std::abs(z) : z; }

// the value that a share `level` of n + 1 draws is above, the n given ones and one more
double upper_quantile(std::vector<double> values) {
  auto const above = static_cast<std::size_t>(level * static_cast<double>(values.size() + 1));
  if (above == 0) return std::numeric_limits<double>::infinity();
  auto const place = values.begin() + static_cast<std::ptrdiff_t>(above - 1);
  std::nth_element(values.begin(), place, values.end(), std::greater<>());
  return *place;
}

Thresholds thresholds_of(std::span<CellScores const> readings, Tail tail) {
  std::vector<double> largest, single;
  for (Eigen::Index t = 0; t < readings.front().replicates.cols(); ++t) {
    double most = -std::numeric_limits<double>::infinity();
    for (CellScores const& scores : readings)
      for (double z : scores.replicates.col(t)) {
        if (std::isnan(z)) continue;
        single.push_back(extremity(z, tail));
        most = std::max(most, single.back());
      }
    largest.push_back(most);
  }
  return {upper_quantile(std::move(largest)), upper_quantile(std::move(single))};
}

class RunFinder {
 public:
  RunFinder(CellScores const& scores, std::span<double const> edges, Thresholds const& thresholds, Tail tail)
      : z_(scores.recording), edges_(edges), thresholds_(thresholds), tail_(tail) {}

  std::vector<CellRun> runs() const {
    std::vector<CellRun> result;
    int const n = static_cast<int>(z_.size());
    for (int cell = 0; cell < n; ++cell) {
      if (std::isnan(z_[cell]) || !(extremity(z_[cell], tail_) > thresholds_.seed)) continue;
      CellRun const run{reach(cell, -1), reach(cell, 1)};
      result.push_back(run);
      cell = run.last;
    }
    return result;
  }

 private:
  bool without_width(int cell) const {
    auto const at = static_cast<std::size_t>(cell);
    return std::isnan(z_[cell]) && edges_[at] == edges_[at + 1];
  }

  // the last cell of the same kind in one direction
  int reach(int seed, int step) const {
    int end = seed;
    for (int cell = seed + step; cell >= 0 && cell < z_.size(); cell += step) {
      if (without_width(cell)) continue;
      bool const same_sign = z_[cell] * z_[seed] > 0.0;
      if (!same_sign || !(extremity(z_[cell], tail_) > thresholds_.growth)) break;
      end = cell;
    }
    return end;
  }

  Eigen::VectorXd const& z_;
  std::span<double const> edges_;
  Thresholds thresholds_;
  Tail tail_;
};

std::vector<CellRun> merged(std::vector<CellRun> runs) {
  std::sort(runs.begin(), runs.end(), [](CellRun const& a, CellRun const& b) { return a.first < b.first; });
  std::vector<CellRun> result;
  for (CellRun const& run : runs) {
    if (!result.empty() && run.first <= result.back().last)
      result.back().last = std::max(result.back().last, run.last);
    else
      result.push_back(run);
  }
  return result;
}

}  // namespace

CellScores score_cells(Eigen::MatrixXd const& values) {
  Eigen::Index const n_replicates = values.cols() - 1;
  CellScores scores{Eigen::VectorXd::Constant(values.rows(), unknown),
                    Eigen::MatrixXd::Constant(values.rows(), n_replicates, unknown)};
  std::vector<double> replicates(static_cast<std::size_t>(n_replicates));
  for (Eigen::Index cell = 0; cell < values.rows(); ++cell) {
    if (std::isnan(values(cell, 0))) continue;
    for (std::size_t t = 0; t < replicates.size(); ++t) replicates[t] = values(cell, static_cast<Eigen::Index>(t) + 1);
    scores.recording[cell] = replicate_z(values(cell, 0), replicates);
    auto const among_others = standardised_replicates(replicates);
    for (std::size_t t = 0; t < replicates.size(); ++t)
      scores.replicates(cell, static_cast<Eigen::Index>(t)) = among_others[t];
  }
  return scores;
}

std::vector<CellRun> unusual_runs(std::span<CellScores const> readings, std::span<double const> edges, Tail tail) {
  TORQUESCOPE_EXPECT(!readings.empty());
  TORQUESCOPE_EXPECT(static_cast<Eigen::Index>(edges.size()) == readings.front().recording.size() + 1);
  Thresholds const thresholds = thresholds_of(readings, tail);
  std::vector<CellRun> runs;
  for (CellScores const& scores : readings) {
    auto const found = RunFinder(scores, edges, thresholds, tail).runs();
    runs.insert(runs.end(), found.begin(), found.end());
  }
  return merged(std::move(runs));
}

}  // namespace torquescope
