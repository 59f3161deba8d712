// Quantiles of many have on every instruction set the bits of one alone.

#include "kernels/normal_quantiles.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "engine/base/portable_math.hpp"
#include "engine/base/random_stream.hpp"
#include "unit/kernels/every_instruction_set.hpp"

namespace torquescope::kernels {
namespace normal_quantiles_test {

class NormalQuantiles : public EveryInstructionSet {};

void expect_bits_of_one(std::vector<double> const& probabilities) {
  double const guard = 17.0;
  std::vector<double> quantiles(probabilities.size() + 8, guard), in_place = probabilities;
  normal_quantiles(probabilities.data(), probabilities.size(), quantiles.data());
  normal_quantiles(in_place.data(), in_place.size(), in_place.data());
  for (std::size_t i = 0; i < probabilities.size(); ++i) {
    ASSERT_EQ(quantiles[i], normal_quantile(probabilities[i])) << probabilities[i];
    ASSERT_EQ(in_place[i], quantiles[i]);
  }
  for (std::size_t i = probabilities.size(); i < quantiles.size(); ++i) ASSERT_EQ(quantiles[i], guard);
}

TEST_P(NormalQuantiles, HaveTheBitsOfOneAlone) {
  RandomStream random({5, 0, RandomDomain::test}, 0, 0);
  for (std::size_t n : {0, 1, 7, 8, 9, 255, 256, 257, 100000}) {
    std::vector<double> probabilities(n);
    for (double& one : probabilities) one = RandomStream::probability(random.bits());
    expect_bits_of_one(probabilities);
  }
}

TEST_P(NormalQuantiles, KnowTheFarTailsAndTheirBorders) {
  std::vector<double> probabilities{0x1.0p-54, 1.0 - 0x1.0p-53, 0.5, 0.075, 0.925, std::exp(-25.0), 1e-300};
  for (double const border : {0.075, 0.925, std::exp(-25.0)})
    for (double const beyond : {0.0, 1.0}) probabilities.push_back(std::nextafter(border, beyond));
  RandomStream random({6, 0, RandomDomain::test}, 0, 0);
  for (int i = 0; i < 2000; ++i) {
    probabilities.push_back(std::ldexp(random.uniform(0.5, 1.0), -static_cast<int>(random.below(900))));
    probabilities.push_back(1.0 - std::ldexp(random.uniform(0.5, 1.0), -1 - static_cast<int>(random.below(52))));
  }
  expect_bits_of_one(probabilities);
  // all of them in tails
  std::erase_if(probabilities, [](double p) { return std::fabs(p - 0.5) <= 0.425; });
  expect_bits_of_one(probabilities);
}

INSTANTIATE_TEST_SUITE_P(Target, NormalQuantiles, testing::ValuesIn(supported_instruction_sets()), instruction_set_of);

}  // namespace normal_quantiles_test
}  // namespace torquescope::kernels
