#pragma once
// The k-th smallest of many numbers, without a copy of them: they are asked for again a few times instead.
//
// Equation   values sorted upwards, the one at index k: the same number as std::nth_element would put there
// Method     two values of an even sample enclose the k-th with all likelihood; how many lie below and which lie
//            between is counted, until what is left fits into `most_kept` numbers. A sample that misled costs another
//            round
// Rounds     two for some 1e6 values, three for more
// Memory     twice most_kept doubles, whatever n
// Requires   no NaN; k < number of values; for_each gives the same values each time
// Threads    free functions

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include "engine/base/contract.hpp"

namespace torquescope {

inline constexpr std::size_t most_kept_values = std::size_t{1} << 15;

// Every value as long as there is room, then every second, every fourth, ...
class EvenSample {
 public:
  explicit EvenSample(std::size_t room) : room_(std::max<std::size_t>(2, room / 2 * 2)) {}

  // the values that each visits
  template <class Visitable>
  void take_from(Visitable const& for_each) {
    // both stay in registers; what is done to the sample happens seldom
    std::size_t counted = 0, until_next = 1;
    for_each([&](double value) {
      ++counted;
      if (--until_next == 0) until_next = take(value);
    });
    n_counted_ = counted;
  }
  std::size_t n_counted() const { return n_counted_; }
  bool has_all() const { return step_ == 1; }
  // in some order; the sample is of no use afterwards
  double at_rank(std::size_t rank) {
    auto const place = kept_.begin() + static_cast<std::ptrdiff_t>(rank);
    std::nth_element(kept_.begin(), place, kept_.end());
    return *place;
  }
  std::size_t size() const { return kept_.size(); }

 private:
  // returns how many values on the next one is wanted
  std::size_t take(double value) {
    if (kept_.size() == room_) {
      for (std::size_t i = 0; 2 * i < room_; ++i) kept_[i] = kept_[2 * i];
      kept_.resize(room_ / 2);
      step_ *= 2;
    }
    kept_.push_back(value);
    return step_;
  }

  std::size_t room_, n_counted_ = 0, step_ = 1;
  std::vector<double> kept_{};
};

// for_each(visit) calls visit(double) for every value
template <class ForEach>
double kth_smallest(ForEach const& for_each, std::size_t k, std::size_t most_kept = most_kept_values) {
  EvenSample sample(most_kept);
  sample.take_from(for_each);
  TORQUESCOPE_EXPECT(k < sample.n_counted());

  // the k-th of all is the k-th of those from `least` to `most`
  double least = -std::numeric_limits<double>::infinity(), most = std::numeric_limits<double>::infinity();
  bool stuck = false;
  while (!sample.has_all()) {
    std::size_t const left = sample.n_counted();
    auto const size = static_cast<double>(sample.size());
    double const rank = static_cast<double>(k) / static_cast<double>(left) * size;
    // three standard deviations of a rank in a sample; a single pivot always gets on
    double const margin = stuck ? 0.0 : 1.0 + 1.6 * std::sqrt(size);
    auto const index = [&](double at) { return static_cast<std::size_t>(std::clamp(at, 0.0, size - 1.0)); };
    double const low = sample.at_rank(index(rank - margin)), high = sample.at_rank(index(rank + margin));

    std::size_t n_below = 0, n_above = 0;
    EvenSample between(most_kept);
    between.take_from([&](auto const& visit) {
      for_each([&](double value) {
        // sums of comparisons: which side a value is on, no processor can foresee
        bool const below = value<low, above = value> high;
        n_below += below & (value >= least);
        n_above += above & (value <= most);
        if (!(below | above)) visit(value);
      });
    });
    TORQUESCOPE_ENSURE(n_below + n_above + between.n_counted() == left);
    bool const is_below = k < n_below, is_above = k >= left - n_above;
    stuck = !is_below && !is_above && between.n_counted() == left;
    if (is_below || is_above) {
      // seldom: the sample was no even one
      if (is_below) most = std::nextafter(low, -std::numeric_limits<double>::infinity());
      if (is_above) least = std::nextafter(high, std::numeric_limits<double>::infinity());
      if (is_above) k -= left - n_above;
      sample = EvenSample(most_kept);
      sample.take_from([&](auto const& visit) {
        for_each([&](double value) {
          if (least <= value && value <= most) visit(value);
        });
      });
      continue;
    }
    if (low == high) return low;
    k -= n_below;
    least = low;
    most = high;
    sample = std::move(between);
  }
  return sample.at_rank(k);
}

}  // namespace torquescope
