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

double parameter_change(Population const& before, Population const& after, Bounds const& bounds, MovementNorm norm) {
  double sum = 0.0;
  for (std::size_t i = 0; i < before.size(); ++i) {
    for (std::size_t j = 0; j < before.dimension; ++j) {
      double const unit = norm == MovementNorm::raw ? 1.0 : bounds.upper[j] - bounds.lower[j];
      double const step = (after.members()(i, j) - before.members()(i, j)) / unit;
      sum += step * step;
    }
  }
  return std::sqrt(sum / static_cast<double>(before.size()));
}

// range of the finite fitness values of both generations, halved so that it cannot overflow
double half_spread(Population const& before, Population const& after) {
  double least = std::numeric_limits<double>::infinity();
  double most = -least;
  for (auto const* fitness : {&before.fitness, &after.fitness}) {
    for (double const f : *fitness) {
      if (!std::isfinite(f)) continue;
      least = std::min(least, f);
      most = std::max(most, f);
    }
  }
  return most > least ? 0.5 * most - 0.5 * least : 0.0;
}

double function_change(Population const& before, Population const& after, MovementNorm norm) {
  double const half_unit = norm == MovementNorm::raw ? 0.5 : half_spread(before, after);
  if (half_unit == 0.0) return 0.0;  // all values equal: nothing changed
  double sum = 0.0;
  for (std::size_t i = 0; i < before.size(); ++i) {
    if (!std::isfinite(before.fitness[i]) || !std::isfinite(after.fitness[i])) continue;
    double const step = (0.5 * after.fitness[i] - 0.5 * before.fitness[i]) / half_unit;
    sum += step * step;
  }
  return std::sqrt(sum / static_cast<double>(before.size()));
}

}  // namespace

Movement movement_between(Population const& before, Population const& after, Bounds const& bounds, MovementNorm norm) {
  TORQUESCOPE_EXPECT(before.size() == after.size() && before.size() >= 1);
  TORQUESCOPE_EXPECT(before.dimension == after.dimension && before.dimension == bounds.dimension());
  return {parameter_change(before, after, bounds, norm), function_change(before, after, norm)};
}

}  // namespace torquescope
