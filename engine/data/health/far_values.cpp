#include "engine/data/health/far_values.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include "engine/base/median.hpp"
#include "engine/data/health/examination.hpp"
#include "engine/data/levels.hpp"
#include "engine/data/signal_facts.hpp"

namespace torquescope {
namespace {

// of sorted values that are still taken as data, those of a magnitude apart
struct Extremes {
  std::size_t least, end;  // the others stand in [least, end)
};

Extremes without(std::vector<double> const& sorted, double magnitude) {
  Extremes rest{0, sorted.size()};
  while (rest.least < rest.end && std::fabs(sorted[rest.least]) == magnitude) ++rest.least;
  while (rest.end > rest.least && std::fabs(sorted[rest.end - 1]) == magnitude) --rest.end;
  return rest;
}

// whether the value furthest to one side is far from all others, its magnitude; sorted: at least one
std::optional<double> far_magnitude(std::vector<double> const& sorted, double extreme) {
  double const magnitude = std::fabs(extreme);
  auto const rest = without(sorted, magnitude);
  std::size_t const times = sorted.size() - (rest.end - rest.least);
  if (magnitude == 0.0 || times < levels::far_value_repeats || rest.end - rest.least < levels::fewest_runs) return {};
  double const low = sorted[rest.least], high = sorted[rest.end - 1];
  double const apart = extreme > high ? extreme - high : low - extreme;
  return high > low && apart > levels::ranges_beyond * (high - low) ? std::optional(magnitude) : std::nullopt;
}

std::vector<double> magnitudes_outside(std::vector<double> sorted) {
  std::vector<double> found;
  std::sort(sorted.begin(), sorted.end());
  while (!sorted.empty()) {
    auto far = far_magnitude(sorted, sorted.back());
    if (!far) far = far_magnitude(sorted, sorted.front());
    if (!far) break;
    found.push_back(*far);
    auto const rest = without(sorted, *far);
    sorted.erase(sorted.begin() + static_cast<std::ptrdiff_t>(rest.end), sorted.end());
    sorted.erase(sorted.begin(), sorted.begin() + static_cast<std::ptrdiff_t>(rest.least));
  }
  return found;
}

// a run of equal values among those that are known: places, not rows
struct Place {
  std::size_t first, end;
};

// where each value is met
std::map<double, std::vector<Place>> places_of(std::vector<double> const& x) {
  std::map<double, std::vector<Place>> places;
  for (std::size_t i = 0; i < x.size();) {
    std::size_t end = i + 1;
    while (end < x.size() && x[end] == x[i]) ++end;
    places[x[i]].push_back({i, end});
    i = end;
  }
  return places;
}

double typical_step(std::vector<double> const& x) {
  std::vector<double> steps;
  for (std::size_t i = 1; i < x.size(); ++i) steps.push_back(std::fabs(x[i] - x[i - 1]));
  return upper_median(std::move(steps));
}

// away from the rows beside it, which go on as if neither it nor others of its value were there. least: of its size
bool is_far(std::vector<double> const& x, Place const& place, double least) {
  if (place.end - place.first > levels::far_value_rows) return false;
  double const value = x[place.first];
  auto const others = [&](auto from, auto until) {
    std::vector<double> next;
    for (; from != until && next.size() < 2; ++from)
      if (*from != value) next.push_back(*from);
    return next;
  };
  auto const before = others(x.rend() - static_cast<std::ptrdiff_t>(place.first), x.rend());
  auto const after = others(x.begin() + static_cast<std::ptrdiff_t>(place.end), x.end());
  if (before.size() < 2 || after.size() < 2) return false;
  double const size = std::min(std::fabs(value - before[0]), std::fabs(value - after[0]));
  double const around = std::max(std::fabs(before[0] - before[1]), std::fabs(after[1] - after[0]));
  return size > least && size > levels::times_steps_around * around &&
         std::fabs(after[0] - before[0]) <= levels::returned_share * size;
}

}  // namespace

std::vector<FarValue> values_outside(std::vector<double> const& values) {
  std::vector<double> x;
  for (std::size_t row : known_rows(values)) x.push_back(values[row]);
  std::vector<FarValue> found;
  for (double magnitude : magnitudes_outside(std::move(x)))
    for (double value : {magnitude, -magnitude}) {
      FarValue far{value, {}};
      for (std::size_t row = 0; row < values.size(); ++row)
        if (values[row] == value) far.rows.push_back(row);
      if (!far.rows.empty()) found.push_back(std::move(far));
    }
  return found;
}

std::vector<FarValue> values_inside(std::vector<double> const& values) {
  auto const known = known_rows(values);
  std::vector<double> x;
  for (std::size_t row : known) x.push_back(values[row]);
  if (x.size() < levels::fewest_runs) return {};
  double const least =
      std::max(levels::times_typical_step * typical_step(x), levels::times_encoder_step * quantisation_step(x));
  std::vector<FarValue> found;
  std::vector<std::size_t> counts;  // of far places
  std::size_t all = 0;
  for (auto const& [value, places] : places_of(x)) {
    FarValue far{value, {}};
    std::size_t count = 0;
    for (auto const& place : places) {
      if (!is_far(x, place, least)) continue;
      ++count;
      for (std::size_t k = place.first; k < place.end; ++k) far.rows.push_back(known[k]);
    }
    all += count;
    if (count < levels::far_value_places || 2 * count < places.size()) continue;
    found.push_back(std::move(far));
    counts.push_back(count);
  }
  // spikes of a coarse channel are spread over many values, some of which repeat
  std::vector<FarValue> sentinels;
  for (std::size_t i = 0; i < found.size(); ++i)
    if (static_cast<double>(counts[i]) >= levels::far_value_share * static_cast<double>(all))
      sentinels.push_back(std::move(found[i]));
  return sentinels;
}

}  // namespace torquescope
