#include "engine/data/health/value_runs.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/base/median.hpp"
#include "engine/data/levels.hpp"
#include "engine/data/signal_facts.hpp"

namespace torquescope {
namespace {

struct Runs {
  std::vector<std::size_t> first;    // row of each change
  std::vector<std::size_t> lengths;  // from it to the next change: one less
};

Runs runs_between_changes(std::span<double const> values) {
  Runs runs;
  for (std::size_t i = 1; i < values.size(); ++i)
    if (values[i] != values[i - 1]) runs.first.push_back(i);
  for (std::size_t k = 1; k < runs.first.size(); ++k) runs.lengths.push_back(runs.first[k] - runs.first[k - 1]);
  return runs;
}

// nearer to one sample than to two, or a row longer that the log's own clock adds
bool is_one_sample(std::size_t length, double rows) {
  return static_cast<double>(length) <= std::max(levels::one_sample_at_most * rows, rows + 1.0);
}

// T of the header
double rows_of_a_sample(std::vector<std::size_t> const& lengths) {
  constexpr int enough = 5;
  auto rows = static_cast<double>(upper_median(lengths));
  for (int k = 0; k < enough && rows > 1.0; ++k) {
    double sum = 0.0, count = 0.0;
    for (std::size_t length : lengths)
      if (is_one_sample(length, rows)) sum += static_cast<double>(length), ++count;
    if (count > 0.0) rows = sum / count;
  }
  return rows;
}

bool are_hardly_shorter(std::vector<std::size_t> const& lengths, double rows) {
  auto const is_short = [&](std::size_t length) { return static_cast<double>(length) < 0.5 * rows; };
  auto const count = std::count_if(lengths.begin(), lengths.end(), is_short);
  return static_cast<double>(count) <= levels::runs_cut_short * static_cast<double>(lengths.size());
}

// changes that go further than one step of an encoder, the smallest change there is
bool are_more_than_steps(std::span<double const> values, std::vector<std::size_t> const& changes) {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i : changes) least = std::min(least, std::fabs(values[i] - values[i - 1]));
  double const one_step = levels::one_step_at_most * std::max(least, quantisation_step(values));
  auto const is_far = [&](std::size_t i) { return std::fabs(values[i] - values[i - 1]) > one_step; };
  auto const count = std::count_if(changes.begin(), changes.end(), is_far);
  return 2 * static_cast<std::size_t>(count) >= changes.size();
}

std::size_t samples_in(std::size_t length, double rows) {
  if (static_cast<double>(length) <= levels::late_sample_at_most * rows) return 1;
  return static_cast<std::size_t>(std::round(static_cast<double>(length) / rows));
}

// The rows at which the source was read: the first of each run, and evenly over a run of several samples. What stands
// before the first change is as old as nobody knows, unless it is a whole sample
std::vector<std::size_t> sampled_rows(Runs const& runs, std::size_t n_values, double rows) {
  std::vector<std::size_t> samples;
  auto const add = [&](std::size_t first, std::size_t length) {
    std::size_t const parts = samples_in(length, rows);
    for (std::size_t k = 0; k < parts; ++k) samples.push_back(first + k * length / parts);
  };
  std::size_t const head = runs.first.front();
  auto const whole = static_cast<std::size_t>(std::floor(static_cast<double>(head) / rows + 1e-9));
  for (std::size_t k = whole; k > 0; --k)
    samples.push_back(head - static_cast<std::size_t>(std::floor(static_cast<double>(k) * rows)));
  for (std::size_t k = 0; k < runs.lengths.size(); ++k) add(runs.first[k], runs.lengths[k]);
  add(runs.first.back(), n_values - runs.first.back());
  return samples;
}

}  // namespace

SlowSource slow_source_of(std::span<double const> values) {
  Runs const runs = runs_between_changes(values);
  if (runs.lengths.size() < levels::fewest_runs) return {};
  double const rows = rows_of_a_sample(runs.lengths);
  if (rows < levels::slow_from_rows || !are_hardly_shorter(runs.lengths, rows)) return {};
  if (!are_more_than_steps(values, runs.first) && held_rows(values) <= 1) return {};
  return {rows, sampled_rows(runs, values.size(), rows)};
}

}  // namespace torquescope
