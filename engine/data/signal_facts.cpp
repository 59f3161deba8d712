#include "engine/data/signal_facts.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/base/median.hpp"
#include "engine/base/order_statistic.hpp"

namespace torquescope {
namespace {

// the upper median
template <class ForEach>
double median_of(ForEach const& for_each, std::size_t n_values) {
  return kth_smallest(for_each, n_values / 2);
}

// the value furthest to one side, the next one, and how often each is met
class Extreme {
 public:
  explicit Extreme(double side) : side_(side) {}
  void count(double value) {
    double const v = side_ * value;
    if (v < second_) return;  // nearly all
    if (v > first_) {
      second_ = first_;
      n_second_ = n_first_;
      first_ = v;
      n_first_ = 1;
    } else if (v == first_) {
      ++n_first_;
    } else if (v > second_) {
      second_ = v;
      n_second_ = 1;
    } else if (v == second_) {
      ++n_second_;
    }
  }
  double value() const { return side_ * first_; }
  double next() const { return side_ * second_; }
  // three times as often as its neighbour: a signal that turns round by itself visits both alike
  bool is_limit() const { return n_first_ > 3 * n_second_; }

 private:
  double side_;
  double first_ = -std::numeric_limits<double>::infinity(), second_ = first_;
  std::size_t n_first_ = 0, n_second_ = 0;
};

// samples in runs of three and more at the given value
std::size_t samples_resting_at(std::span<double const> values, double level) {
  std::size_t resting = 0, run = 0;
  for (double value : values) {
    run = value == level ? run + 1 : 0;
    if (run == 3) resting += 3;
    if (run > 3) ++resting;
  }
  return resting;
}

}  // namespace

double quantisation_step(std::span<double const> values) {
  if (values.size() < 2) return 0.0;
  Eigen::Map<Eigen::ArrayXd const> const signal(values.data(), static_cast<Eigen::Index>(values.size()));
  double const range = (signal.tail(signal.size() - 1) - signal.head(signal.size() - 1)).abs().maxCoeff();
  // printed digits make equal steps differ a little: what is a thousand times smaller than the largest is no step
  auto const for_each_step = [&](auto const& visit) {
    for (std::size_t i = 1; i < values.size(); ++i) {
      double const step = std::fabs(values[i] - values[i - 1]);
      if (step > 0 && !(step < 1e-9 * range)) visit(step);
    }
  };
  std::size_t n_steps = 0;
  double least = std::numeric_limits<double>::infinity();
  for_each_step([&](double step) {
    ++n_steps;
    least = std::min(least, step);
  });
  if (n_steps < 8) return 0.0;

  // the smallest step, averaged over all that are about as small
  auto const for_each_single = [&](auto const& visit) {
    for_each_step([&](double step) {
      if (step < 1.5 * least) visit(step);
    });
  };
  std::size_t n_single = 0;
  for_each_single([&](double) { ++n_single; });
  // a real step is met again and again, and every other difference is a multiple of it
  bool const met_often = n_single * 200 >= n_steps && n_single >= 4;
  if (!met_often) return 0.0;
  double const candidate = median_of(for_each_single, n_single);
  std::size_t multiples = 0, small = 0;
  for_each_step([&](double step) {
    double const count = step / candidate;
    if (count > 50) return;  // printed digits blur large multiples
    ++small;
    multiples += std::fabs(count - std::round(count)) < 0.05;
  });
  return multiples * 100 >= 98 * small ? candidate : 0.0;
}

double limit_share(std::span<double const> values) {
  if (values.size() < 8) return 0.0;
  Extreme low(-1.0), high(1.0);
  for (double value : values) {
    low.count(value);
    high.count(value);
  }
  if (!(low.next() < high.next())) return 0.0;  // at most three values: on and off, its levels are not limits
  auto const resting_at = [&](Extreme const& level) {
    return level.is_limit() ? samples_resting_at(values, level.value()) : 0;
  };
  return static_cast<double>(resting_at(low) + resting_at(high)) / static_cast<double>(values.size());
}

Eigen::Index held_rows(std::span<double const> values) {
  constexpr double most_of_them = 0.9;
  constexpr std::size_t fewest = 20, longest = 1000;
  std::vector<std::size_t> changes;
  for (std::size_t i = 1; i < values.size(); ++i)
    if (values[i] != values[i - 1]) changes.push_back(i);
  if (changes.size() < fewest) return 1;
  std::vector<std::size_t> times(longest + 1);  // that a way from one change to the next is so many rows
  for (std::size_t k = 1; k < changes.size(); ++k) ++times[std::min(changes[k] - changes[k - 1], longest)];
  auto const held = static_cast<std::size_t>(std::max_element(times.begin(), times.end()) - times.begin());
  if (held < 2 || held == longest) return 1;
  std::vector<std::size_t> on_grid(held);
  for (std::size_t row : changes) ++on_grid[row % held];
  auto const most = static_cast<double>(*std::max_element(on_grid.begin(), on_grid.end()));
  return most >= most_of_them * static_cast<double>(changes.size()) ? static_cast<Eigen::Index>(held) : 1;
}

double white_noise(Eigen::Ref<Eigen::VectorXd const> const& signal) {
  if (signal.size() < 8) return 0.0;
  auto const for_each_bend = [&](auto const& visit) {
    for (Eigen::Index i = 1; i + 1 < signal.size(); ++i)
      visit(std::fabs(signal[i - 1] - 2 * signal[i] + signal[i + 1]));
  };
  // variance 1 + 4 + 1
  return median_of(for_each_bend, static_cast<std::size_t>(signal.size() - 2)) / (median_of_normal * std::sqrt(6.0));
}

}  // namespace torquescope
