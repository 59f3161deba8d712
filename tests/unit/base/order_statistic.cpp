// The k-th smallest without a copy is the one that sorting finds, whatever the bins do.

#include "engine/base/order_statistic.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "engine/base/median.hpp"
#include "engine/base/random_stream.hpp"

namespace torquescope {
namespace order_statistic_test {

auto each_of(std::vector<double> const& values) {
  return [&values](auto const& visit) {
    for (double const value : values) visit(value);
  };
}

void expect_sorted_order(std::vector<double> const& values, std::size_t most_kept) {
  std::vector<double> sorted = values;
  std::sort(sorted.begin(), sorted.end());
  for (std::size_t k = 0; k < values.size(); k += 1 + values.size() / 97)
    ASSERT_EQ(kth_smallest(each_of(values), k, most_kept), sorted[k]) << k;
  EXPECT_EQ(kth_smallest(each_of(values), values.size() - 1, most_kept), sorted.back());
}

std::vector<double> magnitudes(std::size_t n) {
  RandomStream random({1, 0, RandomDomain::test}, 0, 0);
  std::vector<double> values(n);
  for (auto& value : values) value = std::abs(random.normal()) * std::exp2(std::floor(random.uniform(-60.0, 60.0)));
  return values;
}

TEST(KthSmallest, IsThatOfSorting) {
  for (std::size_t const most_kept : {std::size_t{1}, std::size_t{7}, std::size_t{300}, most_kept_values})
    expect_sorted_order(magnitudes(2000), most_kept);
}

TEST(KthSmallest, OfManyEqualNumbersIsOneOfThem) {
  auto values = magnitudes(500);
  for (std::size_t i = 0; i < values.size(); i += 2) values[i] = i % 4 == 0 ? 0.25 : 0.0;
  expect_sorted_order(values, 3);
  expect_sorted_order(std::vector<double>(1000, 1.0 / 3.0), 3);
}

TEST(KthSmallest, IsThatOfSortingWhereASampleMisleads) {
  // every 2nd, 4th, ... value is large: an even sample sees few of the others
  auto values = magnitudes(4096);
  for (std::size_t i = 0; i < values.size(); i += 16) values[i] += 1e30;
  expect_sorted_order(values, 64);
  // and sorted either way
  std::sort(values.begin(), values.end());
  expect_sorted_order(values, 64);
  std::reverse(values.begin(), values.end());
  expect_sorted_order(values, 64);
}

TEST(KthSmallest, OrdersTheSmallestAndTheLargest) {
  using limits = std::numeric_limits<double>;
  expect_sorted_order({limits::infinity(), 0.0, limits::denorm_min(), limits::min(), limits::max(), 1.0}, 1);
}

TEST(UpperMedian, IsTheMiddleOneAndOfTwoTheGreater) {
  EXPECT_EQ(upper_median(std::vector{3.0, -1.0, 2.0}), 2.0);
  EXPECT_EQ(upper_median(std::vector{4, 1, 3, 2}), 3);
  auto const values = magnitudes(501);
  EXPECT_EQ(upper_median(values), kth_smallest(each_of(values), 250));
}

TEST(MedianOfNormal, HalvesTheSizesOfNormalNumbers) {
  EXPECT_DOUBLE_EQ(std::erf(median_of_normal / std::sqrt(2.0)), 0.5);
}

}  // namespace order_statistic_test
}  // namespace torquescope
