#include "engine/data/health/position_steps.hpp"

#include <algorithm>
#include <cmath>

#include "engine/data/health/examination.hpp"
#include "engine/data/levels.hpp"
#include "engine/data/signal_facts.hpp"

namespace torquescope {
namespace {

// A joint changes its speed from one row to the next by little: a step of five times those around it is none it made.
// Ten times the bends that all but one row in fifty have, because a recording that mostly rests bends seldom
constexpr double times_the_bend = 10.0;

double quantile_of(std::vector<double> values, double share) {
  if (values.empty()) return 0.0;
  auto const at = values.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

double least_size(Roughness const& roughness) {
  return std::max(times_the_bend * roughness.bend, levels::times_encoder_step * roughness.encoder_step);
}

// the values that are numbers, and the rows they stand in
struct Known {
  std::vector<double> x;
  std::vector<std::size_t> rows;
};

Known known_of(std::vector<double> const& values) {
  Known known;
  known.rows = known_rows(values);
  for (std::size_t row : known.rows) known.x.push_back(values[row]);
  return known;
}

double step(std::vector<double> const& x, std::size_t i) { return x[i] - x[i - 1]; }

}  // namespace

Roughness roughness_of(std::vector<double> const& values) {
  constexpr double most_rows = 0.98;
  auto const known = known_of(values);
  std::vector<double> bends;
  for (std::size_t i = 1; i + 1 < known.x.size(); ++i)
    bends.push_back(std::fabs(known.x[i + 1] - 2 * known.x[i] + known.x[i - 1]));
  return {quantile_of(std::move(bends), most_rows), quantisation_step(known.x)};
}

std::vector<Excursion> excursions_of(std::vector<double> const& values, Roughness const& roughness) {
  constexpr std::size_t longest = levels::far_value_rows;
  auto const [x, rows] = known_of(values);
  double const least = least_size(roughness);
  std::vector<Excursion> found;
  for (std::size_t i = 2; i + 2 < x.size(); ++i) {
    if (std::fabs(step(x, i)) < least) continue;
    for (std::size_t count = 1; count <= longest && i + count + 1 < x.size(); ++count) {
      double const before = x[i - 1], after = x[i + count];
      double size = std::fabs(x[i] - before);
      for (std::size_t k = i; k < i + count; ++k)
        size = std::min({size, std::fabs(x[k] - before), std::fabs(x[k] - after)});
      double const around = std::max(std::fabs(step(x, i - 1)), std::fabs(step(x, i + count + 1)));
      if (size < least || size < levels::times_steps_around * around ||
          std::fabs(after - before) > levels::returned_share * size)
        continue;
      found.push_back({rows[i], rows[i + count - 1] - rows[i] + 1, size});
      i += count;
      break;
    }
  }
  return found;
}

namespace {

// of each known row: the rows since the one before, also those that only the clock knows of
std::vector<double> rows_between(std::vector<std::size_t> const& rows, std::vector<double> const& time_s) {
  std::vector<double> between(rows.size(), 1.0), steps;
  for (std::size_t i = 1; i < time_s.size(); ++i) steps.push_back(time_s[i] - time_s[i - 1]);
  double const period = quantile_of(std::move(steps), 0.5);
  for (std::size_t i = 1; i < rows.size(); ++i) {
    between[i] = static_cast<double>(rows[i] - rows[i - 1]);
    if (period > 0.0) between[i] = std::max(between[i], std::round((time_s[rows[i]] - time_s[rows[i - 1]]) / period));
  }
  return between;
}

}  // namespace

std::vector<Jump> jumps_of(std::vector<double> const& values, std::vector<double> const& time_s,
                           Roughness const& roughness) {
  auto const [x, rows] = known_of(values);
  double const least = least_size(roughness);
  auto const between = rows_between(rows, time_s);
  // of a row: over a gap the joint goes on
  auto const speed = [&, &x = x](std::size_t i) { return step(x, i) / between[i]; };
  std::vector<Jump> found;
  for (std::size_t i = 1; i < x.size(); ++i) {
    double const rows_over = between[i];
    if (std::fabs(step(x, i)) < least * rows_over * rows_over) continue;
    double around = 0.0, expected = 0.0;
    int counted = 0;
    for (std::size_t k = i >= 3 ? i - 2 : 1; k <= std::min(i + 2, x.size() - 1); ++k) {
      if (k == i) continue;
      around = std::max(around, std::fabs(speed(k)));
      expected += speed(k);
      ++counted;
    }
    if (counted == 0 || std::fabs(speed(i)) < levels::times_steps_around * around) continue;
    found.push_back({rows[i], step(x, i), expected / counted * rows_over});
  }
  return found;
}

}  // namespace torquescope
