#include "engine/optim/movement.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

namespace torquescope {

std::vector<std::string> const& movement_norm_words() {
  static std::vector<std::string> const words{"raw", "relative"};
  return words;
}

namespace {

double parameter_change(Population const& before, Population const& after, std::span<std::size_t const> winners,
                        Bounds const& bounds, MovementNorm norm) {
  double sum = 0.0;
  for (std::size_t const i : winners) {
    auto const from = before.members().row(i);
    auto const to = after.members().row(i);
    for (std::size_t j = 0; j < before.dimension; ++j) {
      double step = to[j] - from[j];
      if (norm == MovementNorm::relative) step /= bounds.upper[j] - bounds.lower[j];
      sum += step * step;
    }
  }
  return std::sqrt(sum / static_cast<double>(before.size()));
}

bool both_finite(Population const& before, Population const& after, std::size_t i) {
  return std::isfinite(before.fitness[i]) && std::isfinite(after.fitness[i]);
}

double raw_function_change(Population const& before, Population const& after, std::span<std::size_t const> winners) {
  double sum = 0.0;
  for (std::size_t const i : winners) {
    if (!both_finite(before, after, i)) continue;
    double const step = after.fitness[i] - before.fitness[i];
    sum += step * step;
  }
  return std::sqrt(sum / static_cast<double>(before.size()));
}

// least and largest fitness of both generations, of the members that have a change
struct Range {
  double least = std::numeric_limits<double>::infinity();
  double most = -std::numeric_limits<double>::infinity();
};

Range fitness_range(Population const& before, Population const& after) {
  Range range;
  for (std::size_t i = 0; i < before.size(); ++i) {
    if (!both_finite(before, after, i)) continue;
    range.least = std::min({range.least, before.fitness[i], after.fitness[i]});
    range.most = std::max({range.most, before.fitness[i], after.fitness[i]});
  }
  return range;
}

double relative_function_change(Population const& before, Population const& after) {
  auto const range = fitness_range(before, after);
  if (!(range.most > range.least)) return 0.0;  // all values equal: nothing changed
  // fitness as a place in the range, 0 .. 1: halved, so that a difference cannot overflow
  auto const place = [&](double f) { return (0.5 * f - 0.5 * range.least) / (0.5 * range.most - 0.5 * range.least); };

  double n = 0.0;
  double mean = 0.0;
  for (std::size_t i = 0; i < before.size(); ++i) {
    if (!both_finite(before, after, i)) continue;
    n += 1.0;
    mean += 0.5 * (place(before.fitness[i]) + place(after.fitness[i]));
  }
  mean /= n;

  double squared_changes = 0.0;
  double variance = 0.0;
  for (std::size_t i = 0; i < before.size(); ++i) {
    if (!both_finite(before, after, i)) continue;
    double const from = place(before.fitness[i]) - mean;
    double const to = place(after.fitness[i]) - mean;
    squared_changes += (to - from) * (to - from);
    variance += 0.5 * (from * from + to * to) / n;
  }
  return std::sqrt(squared_changes / static_cast<double>(before.size()) / variance);
}

}  // namespace

Movement movement_between(Population const& before, Population const& after, std::span<std::size_t const> winners,
                          Bounds const& bounds, MovementNorm norm) {
  TORQUESCOPE_EXPECT(before.size() == after.size() && before.size() >= 1);
  TORQUESCOPE_EXPECT(before.dimension == after.dimension && before.dimension == bounds.dimension());
  double const FC =
      norm == MovementNorm::raw ? raw_function_change(before, after, winners) : relative_function_change(before, after);
  return {parameter_change(before, after, winners, bounds, norm), FC};
}

}  // namespace torquescope
