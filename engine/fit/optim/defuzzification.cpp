#include "engine/fit/optim/defuzzification.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "engine/base/contract.hpp"

namespace torquescope {

namespace {

double aggregated(SetLevels const& memberships_at_y, SetLevels const& levels) {
  double most = 0.0;
  for (std::size_t k = 0; k < levels.size(); ++k) most = std::max(most, std::min(levels[k], memberships_at_y[k]));
  return most;
}

// every y in (0, top) where the aggregated set can change from one piece (a level or a Gaussian flank) to another
std::vector<double> piece_ends(FuzzyVariable const& output, SetLevels const& levels) {
  std::vector<double> ends{0.0, output.top};
  auto const add = [&](double y) {
    if (y > 0.0 && y < output.top) ends.push_back(y);
  };
  for (std::size_t k = 0; k < levels.size(); ++k) {
    // the flank of set k meets each level
    for (double const level : levels) {
      double const reach = output.sigma * std::sqrt(-2.0 * std::log(level));
      add(output.means[k] - reach);
      add(output.means[k] + reach);
    }
    // the flanks of two sets of one width meet halfway
    for (std::size_t other = 0; other < k; ++other) add(0.5 * (output.means[k] + output.means[other]));
  }
  std::sort(ends.begin(), ends.end());
  return ends;
}

struct AreaMoment {
  double area;
  double moment;
};

AreaMoment level_piece(double level, double from, double to) {
  return {level * (to - from), 0.5 * level * (to - from) * (to + from)};
}

AreaMoment flank_piece(double sigma, double mean, double from, double to) {
  double const a = (from - mean) / sigma;
  double const b = (to - mean) / sigma;
  double const area = sigma * std::sqrt(0.5 * std::numbers::pi) *
                      (std::erf(b * std::numbers::sqrt2 / 2.0) - std::erf(a * std::numbers::sqrt2 / 2.0));
  double const slope = sigma * sigma * (std::exp(-0.5 * a * a) - std::exp(-0.5 * b * b));
  return {area, mean * area + slope};
}

}  // namespace

std::vector<std::string> const& defuzzification_words() {
  static std::vector<std::string> const words{"centroid", "centroid_closed", "weighted_average"};
  return words;
}

double closed_centroid(FuzzyVariable const& output, SetLevels const& levels) {
  auto const ends = piece_ends(output, levels);
  double area = 0.0;
  double moment = 0.0;
  for (std::size_t p = 0; p + 1 < ends.size(); ++p) {
    double const middle = 0.5 * (ends[p] + ends[p + 1]);
    // which set is on top here, and is it clipped?
    auto const curves = memberships(output, middle);
    std::size_t top = 0;
    for (std::size_t k = 1; k < levels.size(); ++k) {
      if (std::min(levels[k], curves[k]) > std::min(levels[top], curves[top])) top = k;
    }
    auto const piece = levels[top] < curves[top] ? level_piece(levels[top], ends[p], ends[p + 1])
                                                 : flank_piece(output.sigma, output.means[top], ends[p], ends[p + 1]);
    area += piece.area;
    moment += piece.moment;
  }
  TORQUESCOPE_EXPECT(area > 0.0);
  return moment / area;
}

double weighted_average(FuzzyVariable const& output, SetLevels const& levels) {
  double sum = 0.0;
  double weighted = 0.0;
  for (std::size_t k = 0; k < levels.size(); ++k) {
    sum += levels[k];
    weighted += levels[k] * output.means[k];
  }
  TORQUESCOPE_EXPECT(sum > 0.0);
  return weighted / sum;
}

GridCentroid::GridCentroid(FuzzyVariable const& output, std::size_t n_points) {
  TORQUESCOPE_EXPECT(n_points >= 2);
  points_.reserve(n_points);
  for (std::size_t p = 0; p < n_points; ++p) {
    double const y = output.top * static_cast<double>(p) / static_cast<double>(n_points - 1);
    bool const at_end = p == 0 || p + 1 == n_points;
    points_.push_back({y, at_end ? 0.5 : 1.0, memberships(output, y)});
  }
}

double GridCentroid::operator()(SetLevels const& levels) const {
  double area = 0.0;
  double moment = 0.0;
  for (auto const& point : points_) {
    double const weighted = point.weight * aggregated(point.memberships, levels);
    area += weighted;
    moment += weighted * point.y;
  }
  TORQUESCOPE_EXPECT(area > 0.0);
  return moment / area;
}

}  // namespace torquescope
