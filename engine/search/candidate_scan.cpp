#include "engine/search/candidate_scan.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "engine/base/parallel.hpp"
#include "engine/statistics/twin_null.hpp"

namespace torquescope {
namespace {

// what one grid point gives
struct PointResult {
  bool is_testable = false;
  double statistic = 0.0;
  double gain = -std::numeric_limits<double>::infinity();
  Eigen::VectorXd parameters{};
  Eigen::VectorXf twin_statistic{};  // M
};

// one slice of the work: some points of one effect, their columns multiplied with all twins at once
struct Slice {
  std::size_t effect = 0, first = 0, last = 0;
};

class Scanner {
 public:
  explicit Scanner(CandidateColumns const& columns) : columns_(columns) {
    auto const& rows = columns.comparison().rows;
    deviations_.resize(rows.size(), rows.n_twins() + 1);
    deviations_.col(0) = rows.residual - rows.twin_mean;
    deviations_.rightCols(rows.n_twins()) = rows.twins.colwise() - rows.twin_mean;
  }

  std::vector<PointResult> points(Effect const& effect, ShapeGrid const& grid, Slice const& slice) const {
    std::vector<std::vector<double>> shapes;
    for (std::size_t i = slice.first; i < slice.last; ++i) shapes.push_back(grid.point(i));
    std::vector<OrthonormalGroup> const groups = columns_.groups(effect, shapes);
    Eigen::Index width = 0;
    for (auto const& group : groups) width += group.rank();
    Eigen::MatrixXd q(deviations_.rows(), width);
    Eigen::Index at = 0;
    for (auto const& group : groups) {
      q.middleCols(at, group.rank()) = group.q;
      at += group.rank();
    }
    Eigen::MatrixXd const products = inner_products(q, deviations_);
    std::vector<PointResult> results;
    at = 0;
    for (auto const& group : groups) {
      results.push_back(point(group, products.middleRows(at, group.rank())));
      at += group.rank();
    }
    return results;
  }

 private:
  PointResult point(OrthonormalGroup const& group, Eigen::MatrixXd const& c) const {
    PointResult result;
    auto const m = static_cast<double>(c.cols() - 1);
    result.twin_statistic.setZero(c.cols() - 1);
    if (group.rank() == 0) return result;
    Eigen::MatrixXd const twins = c.rightCols(c.cols() - 1);
    Eigen::MatrixXd const covariance = twins * twins.transpose() / (m - 1.0);
    Eigen::LLT<Eigen::MatrixXd> const factor(covariance);
    // without noise there is no scale to test on
    if (factor.info() != Eigen::Success || !(covariance.trace() > 0.0)) return result;
    Eigen::VectorXd const data = c.col(0);
    BoundedGain const bounded = bounded_gain(group, data);
    result.is_testable = true;
    result.gain = bounded.gain - covariance.trace() * (1.0 + 1.0 / m);
    result.parameters = bounded.parameters;

    bool const one_sided = group.r.cols() == 1 && group.non_negative[0];
    auto const counts = [&](double value) { return !one_sided || value * group.r(0, 0) > 0.0; };
    if (counts(data[0])) result.statistic = factor.matrixL().solve(data).squaredNorm() / (1.0 + 1.0 / m);
    Eigen::MatrixXd const white = factor.matrixL().solve(twins);
    double const k = m / (m - 1.0);
    for (Eigen::Index t = 0; t < twins.cols(); ++t) {
      if (!counts(twins(0, t))) continue;
      // its own share is taken out of mean and covariance (Sherman, Morrison)
      double const own = white.col(t).squaredNorm() / (m - 1.0);
      double const apart = k * k * (m - 2.0) * own / std::max(1e-9, 1.0 - k * own);
      result.twin_statistic[t] = static_cast<float>(apart / k);
    }
    return result;
  }

  CandidateColumns const& columns_;
  Eigen::MatrixXd deviations_;  // recording first, then the twins
};

void add_point(EffectScan& scan, double& statistic, Eigen::VectorXd& twins, std::size_t index, PointResult&& point) {
  if (!point.is_testable) return;
  statistic = std::max(statistic, point.statistic);
  twins = twins.cwiseMax(point.twin_statistic.cast<double>());
  if (scan.is_testable && point.gain <= scan.gain) return;
  scan.is_testable = true;
  scan.gain = point.gain;
  scan.best_point = index;
  scan.parameters = std::move(point.parameters);
}

void finish(EffectScan& scan, double statistic, Eigen::VectorXd const& twin_statistic) {
  if (!scan.is_testable) return;
  scan.shape = scan.grid.point(scan.best_point);
  std::vector<double> twins(twin_statistic.data(), twin_statistic.data() + twin_statistic.size());
  scan.z = std::sqrt(statistic);
  // on the scale of z the tail of a largest value is nearly exponential or thinner
  for (double& value : twins) value = std::sqrt(value);
  scan.p = tail_p(scan.z, twins);
  std::sort(twins.begin(), twins.end());
  scan.chance_z = twins[static_cast<std::size_t>(0.95 * static_cast<double>(twins.size() - 1))];
  scan.p_is_bound = scan.z > twins.back();
}

}  // namespace

std::vector<EffectScan> scan_candidates(CandidateColumns const& columns, std::vector<Effect const*> const& effects,
                                        int threads) {
  constexpr std::size_t points_at_once = 16;
  std::vector<EffectScan> scans;
  std::vector<Slice> slices;
  for (auto const* effect : effects) {
    if (!effect->exists_on(columns.joint())) continue;
    EffectScan scan;
    scan.effect = effect;
    scan.grid = shape_grid(*effect, columns.scales());
    for (std::size_t first = 0; first < scan.grid.size(); first += points_at_once)
      slices.push_back({scans.size(), first, std::min(scan.grid.size(), first + points_at_once)});
    scans.push_back(std::move(scan));
  }

  Scanner const scanner(columns);
  std::vector<std::vector<PointResult>> results(slices.size());
  parallel_for(slices.size(), threads, [&](std::size_t i, int) {
    auto const& scan = scans[slices[i].effect];
    results[i] = scanner.points(*scan.effect, scan.grid, slices[i]);
  });

  Eigen::Index const m = columns.comparison().rows.n_twins();
  std::vector<double> statistic(scans.size(), 0.0);
  std::vector<Eigen::VectorXd> twins(scans.size(), Eigen::VectorXd::Zero(m));
  for (std::size_t i = 0; i < slices.size(); ++i)
    for (std::size_t k = 0; k < results[i].size(); ++k) {
      std::size_t const e = slices[i].effect;
      add_point(scans[e], statistic[e], twins[e], slices[i].first + k, std::move(results[i][k]));
    }
  for (std::size_t e = 0; e < scans.size(); ++e) finish(scans[e], statistic[e], twins[e]);
  return scans;
}

}  // namespace torquescope
