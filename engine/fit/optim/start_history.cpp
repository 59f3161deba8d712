#include "engine/fit/optim/start_history.hpp"

#include <algorithm>
#include <cmath>

#include "engine/base/contract.hpp"
#include "engine/base/median.hpp"

namespace torquescope {

namespace {

// all of Hansen 2009, table of termination criteria; there the tolerance is absolute
constexpr double flat_share = 1e-12;
constexpr std::size_t flat_generations = 10, stagnant_generations = 120, per_parameter = 30, longest_span = 20000;
constexpr double compared_share = 0.3;

double median_of(std::span<double const> values) { return upper_median(std::vector(values.begin(), values.end())); }

bool is_no_better_now(std::span<double const> values) {
  auto const compared = static_cast<std::size_t>(std::ceil(compared_share * static_cast<double>(values.size())));
  return median_of(values.last(compared)) >= median_of(values.first(compared));
}

}  // namespace

StartHistory::StartHistory(std::size_t dimension, std::size_t n_samples) {
  TORQUESCOPE_EXPECT(dimension >= 1 && n_samples >= 1);
  std::size_t const more = (per_parameter * dimension + n_samples - 1) / n_samples;
  flat_span_ = flat_generations + more;
  least_span_ = stagnant_generations + more;
}

// never forgets a generation that a longer history would look at: generations less these never falls
std::size_t StartHistory::kept(std::size_t generations) const {
  return std::min(generations, std::min(std::max(least_span_, generations / 5), std::max(least_span_, longest_span)));
}

bool StartHistory::is_stuck_after(std::span<double const> fitness) {
  TORQUESCOPE_EXPECT(!fitness.empty());
  std::vector<double> sorted(fitness.begin(), fitness.end());
  std::sort(sorted.begin(), sorted.end());
  ++generations_;
  best_.push_back(sorted.front());
  median_.push_back(sorted[sorted.size() / 2]);
  auto const forgotten = static_cast<std::ptrdiff_t>(best_.size() - kept(generations_));
  best_.erase(best_.begin(), best_.begin() + forgotten);
  median_.erase(median_.begin(), median_.begin() + forgotten);
  return is_flat(sorted) || stagnates();
}

bool StartHistory::is_flat(std::span<double const> sorted) const {
  if (best_.size() < flat_span_) return false;
  auto const recent = std::span(best_).last(flat_span_);
  auto [least, most] = std::ranges::minmax(recent);
  for (double const f : sorted)
    if (std::isfinite(f)) most = std::max(most, f);
  // with an infinite one the range is infinite or NaN: not flat
  return most - least <= flat_share * std::max(std::fabs(most), std::fabs(least)) && std::isfinite(most);
}

bool StartHistory::stagnates() const {
  return generations_ >= least_span_ && is_no_better_now(best_) && is_no_better_now(median_);
}

std::vector<double> StartHistory::numbers() const {
  std::vector<double> all{static_cast<double>(generations_)};
  all.insert(all.end(), best_.begin(), best_.end());
  all.insert(all.end(), median_.begin(), median_.end());
  return all;
}

bool StartHistory::accepts(std::span<double const> numbers) const {
  constexpr double uncountable = 0x1p53;
  if (numbers.empty() || !(numbers[0] >= 0.0 && numbers[0] < uncountable)) return false;
  return numbers.size() == 1 + 2 * kept(static_cast<std::size_t>(numbers[0]));
}

void StartHistory::restore(std::span<double const> numbers) {
  TORQUESCOPE_EXPECT(accepts(numbers));
  generations_ = static_cast<std::size_t>(numbers[0]);
  std::size_t const n = (numbers.size() - 1) / 2;
  best_.assign(numbers.begin() + 1, numbers.begin() + 1 + static_cast<std::ptrdiff_t>(n));
  median_.assign(numbers.begin() + 1 + static_cast<std::ptrdiff_t>(n), numbers.end());
}

}  // namespace torquescope
