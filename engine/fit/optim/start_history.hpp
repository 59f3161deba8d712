#pragma once
// Fitness since a start of an evolution strategy, generation by generation: does another start promise more?
//
// Flat       TolHistFun and EqualFunVals in one: the best of 10 + 30 R / NP generations, and the whole last one, agree
//            to 1e-12 of their size. Relative, because fitness has a unit: a minimum at 0 is for TolX to end
// Stagnation over the last fifth of the generations (120 + 30 R / NP at least, 20 000 at most) the medians of best and
//            of median fitness are no better in the last 30 % than in the first 30 %
// Fitness    +inf where there is none: ranked last, and left out of the last generation's range
// Source     Hansen: Benchmarking a BI-population CMA-ES, GECCO 2009, doi:10.1145/1570256.1570333; Auger, Hansen 2005,
//            doi:10.1109/CEC.2005.1554902

#include <cstddef>
#include <span>
#include <vector>

namespace torquescope {

class StartHistory {
 public:
  StartHistory(std::size_t dimension, std::size_t n_samples);

  // of one whole generation; true: another start promises more
  bool is_stuck_after(std::span<double const> fitness);

  // generations, best of each, median of each: of those that are still looked at
  std::vector<double> numbers() const;
  // whether these can be its numbers
  bool accepts(std::span<double const> numbers) const;
  void restore(std::span<double const> numbers);

 private:
  std::size_t kept(std::size_t generations) const;
  bool is_flat(std::span<double const> sorted) const;
  bool stagnates() const;

  std::size_t flat_span_, least_span_;
  std::size_t generations_ = 0;
  std::vector<double> best_, median_;
};

}  // namespace torquescope
