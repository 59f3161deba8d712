// CMA-ES with growing populations beside restarts of the same size: where one start in many is lucky, and where the
// landscape is smooth.

#include <gtest/gtest.h>

#include <algorithm>

#include "support/landscapes.hpp"

namespace torquescope {
namespace restarts_on_landscapes_test {

constexpr std::size_t dimension = 5;
constexpr std::uint32_t instances = 9;
constexpr std::int64_t budget = 50000;

// ascending, of those that arrived
std::vector<std::int64_t> needed(std::string const& landscape, std::string const& restarts) {
  std::vector<std::int64_t> all;
  for (std::uint32_t run = 0; run < instances; ++run) {
    auto const search =
        testing::make_optimiser("cmaes", testing::cube(dimension, -5.0, 5.0), {46, run}, {{"restarts", restarts}});
    auto const spent =
        testing::evaluations_to_target(*search, testing::Landscape(landscape, dimension, run), 1e-6, budget);
    if (spent > 0) all.push_back(spent);
  }
  std::sort(all.begin(), all.end());
  return all;
}

// a global structure under many minima: a larger population sees it. Nothing is said of bipop, whose small starts take
// half of this budget
TEST(RestartsOnLandscapes, DoublingSolvesMoreOfRastrigin) {
  auto const same = needed("rastrigin", "same").size();
  EXPECT_GT(needed("rastrigin", "ipop").size(), same);
}

// one start suffices: what would come after it changes nothing
TEST(RestartsOnLandscapes, SmoothOnesCostTheSame) {
  for (std::string const landscape : {"sphere", "ellipsoid"}) {
    auto const same = needed(landscape, "same");
    EXPECT_EQ(same.size(), instances) << landscape;
    EXPECT_EQ(needed(landscape, "ipop"), same) << landscape;
    EXPECT_EQ(needed(landscape, "bipop"), same) << landscape;
  }
}

}  // namespace restarts_on_landscapes_test
}  // namespace torquescope
