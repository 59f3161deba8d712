#include "engine/data/sampling.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "engine/base/median.hpp"
#include "engine/data/data_problem.hpp"

namespace torquescope {
namespace {

constexpr double even_within_steps = 0.02;
constexpr double rate_open_by = 0.005;  // relative, when stamps jitter

// stamps as a person would write them: enough digits to see the step
std::string stamp(double time_s, double step_s) {
  int const digits = std::clamp(static_cast<int>(std::ceil(-std::log10(std::fabs(step_s) + 1e-12))), 3, 9);
  return fmt::format("{:.{}f}", time_s, digits);
}

void check_forwards(std::vector<double> const& stamps, RawTable const& table) {
  for (std::size_t i = 1; i < stamps.size(); ++i)
    validate(stamps[i] >= stamps[i - 1], [&] {
      double const step = stamps[i] - stamps[i - 1];
      return bad_data(fmt::format("time runs backwards in {} ({} -> {} s)", row_name(table, i),
                                  stamp(stamps[i - 1], step), stamp(stamps[i], step)),
                      table.path, line_of(table, i),
                      fmt::format("two recordings in one file? split it at {}", row_name(table, i)));
    });
}

std::vector<double> steps_of(std::vector<double> const& times) {
  std::vector<double> steps;
  for (std::size_t i = 1; i < times.size(); ++i) steps.push_back(times[i] - times[i - 1]);
  return steps;
}

// one unit of the last printed decimal, or 0 when the stamps are not rounded
double printed_unit(std::vector<double> const& stamps) {
  double unit = 1.0;
  for (int decimals = 0; decimals <= 9; ++decimals, unit /= 10) {
    bool const fits = std::all_of(stamps.begin(), stamps.end(), [&](double t) {
      double const scaled = t / unit;
      return std::fabs(scaled) < 1e15 && std::fabs(scaled - std::round(scaled)) < 1e-3;
    });
    if (fits) return unit;
  }
  return 0.0;
}

struct EvenGrid {
  double first, step;
  double largest_deviation;
};

// the straight line nearest to the stamps over their index
EvenGrid nearest_grid(std::vector<double> const& times) {
  auto const n = static_cast<double>(times.size());
  double const middle = (n - 1) / 2;
  double const mean = std::accumulate(times.begin(), times.end(), 0.0) / n;
  double product = 0.0, square = 0.0;
  for (std::size_t i = 0; i < times.size(); ++i) {
    double const from_middle = static_cast<double>(i) - middle;
    product += from_middle * (times[i] - mean);
    square += from_middle * from_middle;
  }
  double const step = product / square;
  EvenGrid grid{mean - step * middle, step, 0.0};
  for (std::size_t i = 0; i < times.size(); ++i)
    grid.largest_deviation =
        std::max(grid.largest_deviation, std::fabs(times[i] - grid.first - step * static_cast<double>(i)));
  return grid;
}

void check_step(double step_s, RawTable const& table) {
  validate(step_s > 0, [&] {
    return bad_data(fmt::format("time stands still in {}", table.path), table.path, 0,
                    "name the right time column, or leave columns.time out and write rate_hz");
  });
}

// Requires   gaps that are together longer than the rows are refused: a grid over them would be mostly invented
std::vector<Stretch> find_gaps(Sampling const& sampling, double step, RawTable const& table) {
  std::vector<Stretch> gaps;
  double without_rows = 0.0;
  for (std::size_t k = 1; k < sampling.rows.size(); ++k) {
    Stretch const between{sampling.times[k - 1], sampling.times[k]};
    if (between.until_s - between.from_s <= largest_gap_steps * step) continue;
    gaps.push_back(between);
    without_rows += between.until_s - between.from_s;
    validate(without_rows <= step * static_cast<double>(sampling.rows.size()), [&] {
      return bad_data(fmt::format("{:.0f} samples are missing before {}, more than the recording has",
                                  without_rows / step - 1, row_name(table, sampling.rows[k])),
                      table.path, line_of(table, sampling.rows[k]),
                      "cut the recording there: two recordings stand in one file");
    });
  }
  return gaps;
}

void count_missing(Sampling& sampling, std::vector<double> const& steps, double typical) {
  double sum = 0.0;
  Eigen::Index counted = 0;
  for (double step : steps) {
    if (step > 1.5 * typical) {
      sampling.facts.missing += static_cast<Eigen::Index>(std::llround(step / typical)) - 1;
      continue;
    }
    sum += (step - typical) * (step - typical);
    ++counted;
  }
  sampling.facts.jitter = counted > 0 ? std::sqrt(sum / static_cast<double>(counted)) / typical : 0.0;
}

// all rows, or only the first of each repeated time stamp
std::vector<std::size_t> first_rows(std::vector<double> const& stamps, bool without_repeats) {
  std::vector<std::size_t> rows;
  for (std::size_t i = 0; i < stamps.size(); ++i)
    if (i == 0 || !without_repeats || stamps[i] != stamps[i - 1]) rows.push_back(i);
  return rows;
}

// s since the first row: stamps may be seconds since 1970
std::vector<double> times_of(std::vector<double> const& stamps, std::vector<std::size_t> const& rows) {
  std::vector<double> times;
  times.reserve(rows.size());
  for (std::size_t row : rows) times.push_back(stamps[row] - stamps.front());
  return times;
}

// even rows stand on the grid; its rate is as round as the stamps leave open
Sampling even_sampling(std::vector<std::size_t> rows, EvenGrid const& grid, std::size_t n_repeated) {
  constexpr double surely = 1e-9;
  double const open = grid.largest_deviation / (grid.step * static_cast<double>(rows.size()));
  auto sampling = sampling_at(roundest(1.0 / grid.step, std::max(open, surely)), rows.size());
  sampling.rows = std::move(rows);
  sampling.facts.repeated = static_cast<Eigen::Index>(n_repeated);
  return sampling;
}

}  // namespace

double roundest(double value, double tolerance) {
  for (int digits = 1; digits <= 15; ++digits) {
    double const rounded = std::stod(fmt::format("{:.{}e}", value, digits - 1));
    if (std::fabs(rounded - value) <= tolerance * std::fabs(value)) return rounded;
  }
  return value;
}

double single_precision_unit(std::vector<double> const& stamps) {
  constexpr int digits_of_float = 24;
  double const largest = std::max(std::fabs(stamps.front()), std::fabs(stamps.back()));
  if (!(largest > 0.0)) return 0.0;
  double const unit = std::ldexp(1.0, std::ilogb(largest) - digits_of_float + 1);
  // printed with nine digits, as C does to keep a float, they are off by half of the last one: 1e-8 t at most, beside a
  // bit of 2^-24 t at least
  constexpr double nine_digits = 1e-8 * 0x1p24;
  double const printed = printed_unit(stamps), rounding = 0.6;
  double const off = std::max(1e-3 * unit, printed <= nine_digits * unit ? rounding * printed : 0.0);
  bool const fits = std::all_of(stamps.begin(), stamps.end(), [&](double t) {
    double const nearest = static_cast<double>(static_cast<float>(t));
    return std::fabs(t - nearest) <= off;
  });
  return fits ? unit : 0.0;
}

Sampling sampling_at(double rate_hz, std::size_t n_rows) {
  Sampling sampling;
  sampling.rate_hz = rate_hz;
  sampling.rows.resize(n_rows);
  std::iota(sampling.rows.begin(), sampling.rows.end(), std::size_t{0});
  for (std::size_t i = 0; i < n_rows; ++i) sampling.times.push_back(static_cast<double>(i) / rate_hz);
  return sampling;
}

Sampling analyse_sampling(std::vector<double> const& stamps_s, RawTable const& table, double stamp_unit_s) {
  check_forwards(stamps_s, table);
  auto const every_row = first_rows(stamps_s, false), first_of_repeats = first_rows(stamps_s, true);
  auto const all = nearest_grid(times_of(stamps_s, every_row));
  check_step(all.step, table);
  auto const once = nearest_grid(times_of(stamps_s, first_of_repeats));

  // a few rows written twice on an even clock; with many, the stamps are coarse and the rows differ
  std::size_t const n_repeated = every_row.size() - first_of_repeats.size();
  bool const few_repeats = n_repeated > 0 && 100 * n_repeated < every_row.size();
  if (few_repeats && once.largest_deviation <= even_within_steps * once.step)
    return even_sampling(first_of_repeats, once, n_repeated);

  // even, or even before the stamps were printed: half of the last digit, and some for the fitted line
  constexpr double rounding = 0.6;
  if (all.largest_deviation <=
      std::max(even_within_steps * all.step, rounding * std::max(printed_unit(stamps_s), stamp_unit_s)))
    return even_sampling(every_row, all, 0);

  Sampling sampling;
  sampling.even = false;
  sampling.rows = first_of_repeats;
  sampling.times = times_of(stamps_s, first_of_repeats);
  sampling.facts.repeated = static_cast<Eigen::Index>(n_repeated);
  auto const steps = steps_of(sampling.times);
  double const typical = upper_median(steps);
  check_step(typical, table);
  sampling.gaps = find_gaps(sampling, typical, table);
  count_missing(sampling, steps, typical);
  sampling.rate_hz = roundest(1.0 / typical, rate_open_by);
  return sampling;
}

}  // namespace torquescope
