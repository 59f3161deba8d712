#include "engine/fit/statistics/replicate_null.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "engine/base/random_stream.hpp"

namespace torquescope {
namespace replicate_null_test {

std::vector<double> normals(std::size_t n, std::uint32_t set) {
  std::vector<double> values(n);
  for (std::size_t i = 0; i < n; ++i)
    values[i] = RandomStream({77, set, RandomDomain::test}, 0, static_cast<std::uint32_t>(i)).normal();
  return values;
}

TEST(EmpiricalP, CountsTheDataAsOneMoreReplicate) {
  std::vector<double> const replicates{1, 2, 3, 4};
  EXPECT_EQ(empirical_p(5.0, replicates), 1.0 / 5.0);
  EXPECT_EQ(empirical_p(3.0, replicates), 3.0 / 5.0);  // ties count against the claim
  EXPECT_EQ(empirical_p(0.0, replicates), 1.0);
}

TEST(EmpiricalP, IsUniformWhenTheDataIsAReplicate) {
  // rejection at 5 % over 2000 sets: five binomial standard errors around 0.05 * (M + 1 rounding aside)
  int rejected = 0;
  std::size_t const sets = 2000, M = 99;
  for (std::uint32_t set = 0; set < sets; ++set) {
    auto values = normals(M + 1, set);
    double const data = values.back();
    values.pop_back();
    rejected += empirical_p(data, values) <= 0.05 ? 1 : 0;
  }
  EXPECT_NEAR(rejected, 100.0, 5 * std::sqrt(2000 * 0.05 * 0.95));
}

TEST(ReplicateZ, WidensForTheMeanBeingEstimated) {
  std::vector<double> const replicates{-1.0, 1.0};  // mean 0, variance 2
  EXPECT_DOUBLE_EQ(replicate_z(3.0, replicates), 3.0 / std::sqrt(2.0 * 1.5));
}

TEST(ReplicateZ, OfReplicatesThatAgreeIsInfiniteOrZero) {
  std::vector<double> const replicates{2.0, 2.0, 2.0};
  EXPECT_EQ(replicate_z(2.0, replicates), 0.0);
  EXPECT_EQ(replicate_z(2.5, replicates), HUGE_VAL);
}

TEST(StandardisedReplicates, EqualsLeavingEachOneOut) {
  auto const replicates = normals(25, 3);
  auto const fast = standardised_replicates(replicates);
  for (std::size_t i = 0; i < replicates.size(); ++i) {
    std::vector<double> others = replicates;
    others.erase(others.begin() + static_cast<std::ptrdiff_t>(i));
    EXPECT_NEAR(fast[i], replicate_z(replicates[i], others), 1e-10);
  }
}

}  // namespace replicate_null_test
}  // namespace torquescope
