#include "engine/base/portable_math.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "engine/base/random_stream.hpp"

namespace torquescope {
namespace portable_math_test {

double error_in_ulp(double ours, long double exact) {
  double const rounded = static_cast<double>(exact);
  double const ulp = std::nextafter(std::fabs(rounded), std::numeric_limits<double>::infinity()) - std::fabs(rounded);
  return static_cast<double>(std::fabs(static_cast<long double>(ours) - exact) / static_cast<long double>(ulp));
}

TEST(PortableExp, StaysWithinTwoUlpOfLongDouble) {
  RandomStream stream({3, 0, RandomDomain::test}, 0, 0);
  for (int i = 0; i < 200000; ++i) {
    double const x = stream.uniform(-700.0, 700.0);
    ASSERT_LE(error_in_ulp(portable_exp(x), std::exp(static_cast<long double>(x))), 2.0) << x;
    double const small = stream.uniform(-1.0, 1.0);
    ASSERT_LE(error_in_ulp(portable_exp(small), std::exp(static_cast<long double>(small))), 2.0) << small;
  }
}

TEST(PortableExp, KeepsItsEdges) {
  EXPECT_EQ(portable_exp(0.0), 1.0);
  EXPECT_EQ(portable_exp(-1000.0), 0.0);
  EXPECT_EQ(portable_exp(1000.0), std::numeric_limits<double>::infinity());
  EXPECT_TRUE(std::isnan(portable_exp(std::numeric_limits<double>::quiet_NaN())));
  EXPECT_NEAR(portable_exp(-740.0) / std::exp(-740.0), 1.0, 0.01);  // subnormal: few digits
}

TEST(PortableLog, StaysWithinTwoUlpOfLongDouble) {
  RandomStream stream({4, 0, RandomDomain::test}, 0, 0);
  for (int i = 0; i < 200000; ++i) {
    double const x = std::ldexp(stream.uniform(0.5, 1.0), static_cast<int>(stream.below(600)) - 300);
    ASSERT_LE(error_in_ulp(portable_log(x), std::log(static_cast<long double>(x))), 2.0) << x;
    double const near_one = stream.uniform(0.7, 1.4);
    ASSERT_LE(error_in_ulp(portable_log(near_one), std::log(static_cast<long double>(near_one))), 2.0) << near_one;
  }
}

TEST(NormalQuantile, InvertsTheErrorFunction) {
  for (double p : {1e-12, 1e-6, 0.001, 0.025, 0.1, 0.5, 0.8, 0.975, 0.999, 1 - 1e-9}) {
    double const z = normal_quantile(p);
    EXPECT_NEAR(0.5 * std::erfc(-z / std::sqrt(2.0)) / p, 1.0, 1e-12) << p;
  }
  EXPECT_NEAR(normal_quantile(0.975), 1.959963984540054, 1e-14);
}

}  // namespace portable_math_test
}  // namespace torquescope
