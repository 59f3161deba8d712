#include "engine/fit/optim/movement.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

namespace torquescope {

std::vector<std::string> const& movement_norm_words() {
  static std::vector<std::string> const words{"raw", "relative", "spread"};
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

// root mean square of the changes of one number per member, in standard deviations of both generations together;
// members for which it is not finite have no change
template <class Before, class After>
double relative_change(std::size_t n_members, Before const& before, After const& after) {
  auto const both_finite = [&](std::size_t i) { return std::isfinite(before(i)) && std::isfinite(after(i)); };
  double least = std::numeric_limits<double>::infinity(), most = -least;
  for (std::size_t i = 0; i < n_members; ++i) {
    if (!both_finite(i)) continue;
    least = std::min({least, before(i), after(i)});
    most = std::max({most, before(i), after(i)});
  }
  if (!(most > least)) return 0.0;  // all values equal: nothing changed
  // a number as its place in the range, 0 .. 1: halved, so that a difference cannot overflow
  auto const place = [&](double f) { return (0.5 * f - 0.5 * least) / (0.5 * most - 0.5 * least); };

  double n = 0.0;
  double mean = 0.0;
  for (std::size_t i = 0; i < n_members; ++i) {
    if (!both_finite(i)) continue;
    n += 1.0;
    mean += 0.5 * (place(before(i)) + place(after(i)));
  }
  mean /= n;

  double squared_changes = 0.0;
  double variance = 0.0;
  for (std::size_t i = 0; i < n_members; ++i) {
    if (!both_finite(i)) continue;
    double const from = place(before(i)) - mean;
    double const to = place(after(i)) - mean;
    squared_changes += (to - from) * (to - from);
    variance += 0.5 * (from * from + to * to) / n;
  }
  return std::sqrt(squared_changes / static_cast<double>(n_members) / variance);
}

double relative_function_change(Population const& before, Population const& after) {
  return relative_change(
      before.size(), [&](std::size_t i) { return before.fitness[i]; }, [&](std::size_t i) { return after.fitness[i]; });
}

double spread_parameter_change(Population const& before, Population const& after) {
  double sum = 0.0;
  for (std::size_t j = 0; j < before.dimension; ++j) {
    double const change = relative_change(
        before.size(), [&](std::size_t i) { return before.members()(i, j); },
        [&](std::size_t i) { return after.members()(i, j); });
    sum += change * change;
  }
  return std::sqrt(sum / static_cast<double>(before.dimension));
}

}  // namespace

Movement movement_between(Population const& before, Population const& after, std::span<std::size_t const> winners,
                          Bounds const& bounds, MovementNorm norm) {
  TORQUESCOPE_EXPECT(before.size() == after.size() && before.size() >= 1);
  TORQUESCOPE_EXPECT(before.dimension == after.dimension && before.dimension == bounds.dimension());
  double const FC =
      norm == MovementNorm::raw ? raw_function_change(before, after, winners) : relative_function_change(before, after);
  double const PC = norm == MovementNorm::spread ? spread_parameter_change(before, after)
                                                 : parameter_change(before, after, winners, bounds, norm);
  return {PC, FC};
}

}  // namespace torquescope
