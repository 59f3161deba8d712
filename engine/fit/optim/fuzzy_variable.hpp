#pragma once
// A fuzzy variable: a universe [0, top] with three Gaussian sets of one width, small, middle and big.
//
// Equation   fg(x, sigma, mean) = exp(-(x - mean)^2 / (2 sigma^2))                          (seed table 1)
// Units      all dimensionless

#include <array>
#include <cstddef>
#include <string>

namespace torquescope {

enum class FuzzySet : std::size_t { small = 0, middle = 1, big = 2 };
inline constexpr std::array<FuzzySet, 3> fuzzy_sets{FuzzySet::small, FuzzySet::middle, FuzzySet::big};

// one number per set: memberships of a value, or the levels at which rules clip the sets
using SetLevels = std::array<double, 3>;

struct FuzzyVariable {
  std::string name;  // "d11"
  double top = 1.0;  // universe [0, top]
  double sigma = 1.0;
  std::array<double, 3> means{};  // small < middle < big; may lie outside the universe
};

double membership(FuzzyVariable const& variable, FuzzySet set, double x);
SetLevels memberships(FuzzyVariable const& variable, double x);

}  // namespace torquescope
