#pragma once
// Gaps to least squares at chosen generations over many runs, and their medians.

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "linear_joint.hpp"
#include "support/optimise.hpp"

namespace torquescope::testing {

inline constexpr std::array<int, 4> milestones{10, 20, 50, 100};
using Medians = std::array<double, milestones.size()>;

// at each milestone the gap of every run, ascending
using Gaps = std::array<std::vector<double>, milestones.size()>;

inline Medians medians_of(Gaps const& gaps) {
  Medians medians{};
  for (std::size_t m = 0; m < gaps.size(); ++m) {
    std::size_t const n = gaps[m].size();
    medians[m] = 0.5 * (gaps[m][(n - 1) / 2] + gaps[m][n / 2]);
  }
  return medians;
}

struct Interval {
  double low, high;
};

// where the true median lies with three standard errors' confidence, whatever the distribution: of n sorted values, the
// count below the median is binomial with standard deviation sqrt(n) / 2
inline Interval median_interval(std::vector<double> const& sorted) {
  auto const n = static_cast<double>(sorted.size());
  double const reach = 1.5 * std::sqrt(n);
  return {sorted[static_cast<std::size_t>(0.5 * n - reach)], sorted[static_cast<std::size_t>(0.5 * n + reach)]};
}

using MakeRun = std::function<std::unique_ptr<Optimiser>(RandomKey)>;

inline Gaps gaps_of(LinearJoint const& joint, MakeRun const& make_run, int runs, double fitness_scale = 1.0) {
  Gaps gaps;
  for (int run = 0; run < runs; ++run) {
    auto const search = make_run({2014, static_cast<std::uint32_t>(run)});
    for (std::size_t m = 0; m < milestones.size(); ++m) {
      run_to_generation(
          *search, [&](auto b) { return fitness_scale * joint.mse(b); }, milestones[m]);
      gaps[m].push_back(joint.gap(search->progress().best));
    }
  }
  for (auto& at_milestone : gaps) std::sort(at_milestone.begin(), at_milestone.end());
  return gaps;
}

// an optimiser of the registry in the seed's box +-1
inline Gaps gaps_of(LinearJoint const& joint, std::string const& name, std::vector<Setting> const& settings, int runs,
                    double fitness_scale = 1.0) {
  auto const make_run = [&](RandomKey key) { return make_optimiser(name, cube(4, -1.0, 1.0), key, settings); };
  return gaps_of(joint, make_run, runs, fitness_scale);
}

}  // namespace torquescope::testing
