// The array functions keep the error their header states, against long double, and give the same bits on every
// instruction set and at every place of an array.

#include "kernels/elementary.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cfloat>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "unit/kernels/every_instruction_set.hpp"

namespace torquescope::kernels {
namespace elementary_test {

using Limits = std::numeric_limits<double>;
constexpr double infinity = Limits::infinity();
constexpr std::size_t n = 20001;  // no multiple of any vector

// as the header states them
constexpr double exponential_ulp = 0.7, subnormal_ulp = 0.8, logarithm_ulp = 0.6, power_ulp = 0.7, wave_ulp = 0.9;

// distance to the next double of the size of `exact`
long double ulp_at(long double exact) {
  int exponent = 0;
  std::frexp(exact, &exponent);
  return std::ldexp(1.0L, std::max(exponent, DBL_MIN_EXP) - DBL_MANT_DIG);
}

double error_in_ulp(double value, long double exact) {
  if (std::isnan(value)) return infinity;
  if (std::isinf(value)) return exact > static_cast<long double>(Limits::max()) ? 0.0 : infinity;
  return static_cast<double>(std::abs(static_cast<long double>(value) - exact) / ulp_at(exact));
}

// evenly spread from first to last, with digits in all places
std::vector<double> spread(double first, double last) {
  std::vector<double> x(n);
  std::uint64_t state = 1;
  for (std::size_t i = 0; i < n; ++i) {
    state = state * 6364136223846793005U + 1442695040888963407U;
    double const inside =
        (static_cast<double>(i) + static_cast<double>(state >> 11) * 0x1p-53) / static_cast<double>(n);
    x[i] = first + (last - first) * inside;
  }
  return x;
}

// sizes from 2^first to 2^last, signs in turns
std::vector<double> sizes(double first, double last) {
  auto x = spread(first, last);
  for (std::size_t i = 0; i < n; ++i) x[i] = (i % 2 == 0 ? 1.0 : -1.0) * std::exp2(x[i]);
  return x;
}

struct Waves {
  std::vector<double> cosine, sine;
};

Waves waves_of(double factor, std::vector<double> const& x) {
  Waves waves{std::vector<double>(x.size()), std::vector<double>(x.size())};
  cosine_sine_of_multiple(factor, x.data(), x.size(), waves.cosine.data(), waves.sine.data());
  return waves;
}

struct WaveError {
  double largest = 0.0, at = 0.0;

  void add(double error, double x) {
    if (error <= largest) return;
    largest = error;
    at = x;
  }
};

WaveError wave_error(double factor, std::vector<double> const& x) {
  Waves const waves = waves_of(factor, x);
  WaveError error;
  for (std::size_t i = 0; i < x.size(); ++i) {
    // the product has 106 bits
    long double const high = static_cast<long double>(factor) * static_cast<long double>(x[i]);
    long double const low = std::fma(static_cast<long double>(factor), static_cast<long double>(x[i]), -high);
    error.add(error_in_ulp(waves.cosine[i], std::cos(high) * std::cos(low) - std::sin(high) * std::sin(low)), x[i]);
    error.add(error_in_ulp(waves.sine[i], std::sin(high) * std::cos(low) + std::cos(high) * std::sin(low)), x[i]);
  }
  return error;
}

void expect_small(WaveError const& error, double factor) {
  EXPECT_LE(error.largest, wave_ulp) << "at " << factor << " * " << std::hexfloat << error.at;
}

class Elementary : public EveryInstructionSet {};

TEST_P(Elementary, ExponentialIsWithinItsError) {
  if (LDBL_MANT_DIG <= DBL_MANT_DIG) GTEST_SKIP() << "long double is no better than double here";
  for (auto const& x : {spread(-1.0, 1.0), spread(-708.0, 709.7), spread(-745.2, -708.0), sizes(-1074.0, 2.0)}) {
    std::vector<double> out(n);
    exponential(x.data(), n, out.data());
    for (std::size_t i = 0; i < n; ++i) {
      double const error = error_in_ulp(out[i], std::exp(static_cast<long double>(x[i])));
      ASSERT_LE(error, x[i] < -708.0 ? subnormal_ulp : exponential_ulp) << "e^" << x[i];
    }
  }
}

TEST_P(Elementary, LogarithmIsWithinItsErrorNearOneAsWell) {
  if (LDBL_MANT_DIG <= DBL_MANT_DIG) GTEST_SKIP() << "long double is no better than double here";
  for (auto x : {spread(0.5, 2.0), spread(0.999, 1.001), sizes(-1074.0, 1023.9), spread(1.0, 1e6)}) {
    for (double& value : x) value = std::abs(value);
    std::vector<double> out(n);
    logarithm(x.data(), n, out.data());
    for (std::size_t i = 0; i < n; ++i)
      ASSERT_LE(error_in_ulp(out[i], std::log(static_cast<long double>(x[i]))), logarithm_ulp) << "ln " << x[i];
  }
}

TEST_P(Elementary, PowerIsWithinItsError) {
  if (LDBL_MANT_DIG <= DBL_MANT_DIG) GTEST_SKIP() << "long double is no better than double here";
  for (double const exponent : {0.2, 0.5, 0.87, 1.0, 1.3, 2.0, 3.0, -0.7, -2.0, 1e-3, 37.5, 1e4})
    for (auto const& x : {spread(0.5, 2.0), sizes(-20.0, 20.0), sizes(-1074.0, 1023.9), spread(0.999, 1.001)}) {
      std::vector<double> out(n);
      power_of_size(x.data(), exponent, n, out.data());
      for (std::size_t i = 0; i < n; ++i) {
        long double const exact =
            std::pow(std::abs(static_cast<long double>(x[i])), static_cast<long double>(exponent));
        ASSERT_LE(error_in_ulp(out[i], exact), exact < DBL_MIN ? subnormal_ulp : power_ulp) << x[i] << "^" << exponent;
      }
    }
}

TEST_P(Elementary, WavesAreWithinTheirErrorNearTheirZerosAsWell) {
  if (LDBL_MANT_DIG <= DBL_MANT_DIG) GTEST_SKIP() << "long double is no better than double here";
  for (double const factor : {1.0, 0.3, 17.0, 399.9})
    for (auto const& x : {spread(-3.2, 3.2), spread(-1e4, 1e4), sizes(-1000.0, 33.0)})
      expect_small(wave_error(factor, x), factor);
  // doubles next to multiples of a quarter turn
  std::vector<double> zeros;
  for (int quarter = 1; quarter < 20000; ++quarter)
    zeros.push_back(static_cast<double>(quarter * 1.57079632679489661923132169163975144L));
  expect_small(wave_error(1.0, zeros), 1.0);
  expect_small(wave_error(3.0, zeros), 3.0);
}

TEST_P(Elementary, KnowsTheSpecialValues) {
  double const tiny = Limits::denorm_min(), nan = Limits::quiet_NaN();
  std::vector<double> const x{0.0, -0.0, tiny, -tiny, 1e300, -1e300, infinity, -infinity, nan, 1.0};
  std::vector<double> out(x.size());

  exponential(x.data(), x.size(), out.data());
  for (std::size_t i : {0, 1, 2, 3}) EXPECT_EQ(out[i], 1.0);
  for (std::size_t i : {4, 6}) EXPECT_EQ(out[i], infinity);
  for (std::size_t i : {5, 7}) EXPECT_EQ(out[i], 0.0);
  EXPECT_TRUE(std::isnan(out[8]));

  logarithm(x.data(), x.size(), out.data());
  for (std::size_t i : {0, 1}) EXPECT_EQ(out[i], -infinity);
  for (std::size_t i : {3, 5, 7, 8}) EXPECT_TRUE(std::isnan(out[i])) << x[i];
  EXPECT_DOUBLE_EQ(out[2], std::log(tiny));
  EXPECT_EQ(out[6], infinity);
  EXPECT_EQ(out[9], 0.0);

  for (double const exponent : {0.5, 1.0, 2.0, 0.0, -1.0}) {
    power_of_size(x.data(), exponent, x.size(), out.data());
    for (std::size_t i = 0; i < x.size(); ++i) {
      if (i == 8)
        EXPECT_TRUE(std::isnan(out[i]));
      else
        EXPECT_DOUBLE_EQ(out[i], std::pow(std::abs(x[i]), exponent)) << x[i] << "^" << exponent;
    }
  }

  Waves const waves = waves_of(1.0, x);
  for (std::size_t i : {0, 1, 2, 3}) {
    EXPECT_EQ(waves.cosine[i], 1.0);
    EXPECT_EQ(waves.sine[i], x[i]);
  }
  for (std::size_t i : {4, 5, 6, 7, 8}) {
    EXPECT_TRUE(std::isnan(waves.cosine[i])) << x[i];
    EXPECT_TRUE(std::isnan(waves.sine[i])) << x[i];
  }
  EXPECT_TRUE(std::isfinite(waves_of(1.0, {0x1p45}).sine[0]));
  EXPECT_TRUE(std::isnan(waves_of(1.0, {std::nextafter(0x1p45, infinity)}).sine[0]));
}

TEST_P(Elementary, GivesTheBitsOfOneElementAtEveryPlaceInPlace) {
  auto const x = sizes(-20.0, 8.0);
  for (std::size_t const count : {0, 1, 2, 3, 7, 8, 9, 31}) {
    std::vector<double> e(x.begin(), x.begin() + static_cast<std::ptrdiff_t>(count)), p = e, c = e, s = e, l = e;
    exponential(e.data(), count, e.data());
    logarithm(l.data(), count, l.data());
    power_of_size(p.data(), 0.7, count, p.data());
    cosine_sine_of_multiple(1.7, s.data(), count, c.data(), s.data());
    for (std::size_t i = 0; i < count; ++i) {
      double one = 0.0, other = 0.0;
      exponential(&x[i], 1, &one);
      ASSERT_EQ(e[i], one);
      logarithm(&x[i], 1, &one);
      ASSERT_EQ(std::bit_cast<std::uint64_t>(l[i]), std::bit_cast<std::uint64_t>(one));
      power_of_size(&x[i], 0.7, 1, &one);
      ASSERT_EQ(p[i], one);
      cosine_sine_of_multiple(1.7, &x[i], 1, &one, &other);
      ASSERT_EQ(c[i], one);
      ASSERT_EQ(s[i], other);
    }
  }
}

TEST_P(Elementary, WithNumbersOfTheirOwnEachHasTheBitsOfItAlone) {
  auto x = sizes(-20.0, 8.0);
  x[0] = 0.0;
  x[1] = -infinity;
  x[2] = 0.0;
  for (std::size_t const count : {0, 1, 3, 8, 19}) {
    std::vector<double> numbers(count), p(count), c(count), s(count);
    for (std::size_t i = 0; i < count; ++i) numbers[i] = 0.6 * static_cast<double>(i % 7) - 1.2;  // 0 among them
    power_of_size(x.data(), numbers.data(), count, p.data());
    cosine_sine_of_multiple(numbers.data(), x.data(), count, c.data(), s.data());
    for (std::size_t i = 0; i < count; ++i) {
      double one = 0.0, other = 0.0;
      power_of_size(&x[i], numbers[i], 1, &one);
      ASSERT_EQ(p[i], one) << x[i] << " to " << numbers[i];
      cosine_sine_of_multiple(numbers[i], &x[i], 1, &one, &other);
      ASSERT_EQ(std::bit_cast<std::uint64_t>(c[i]), std::bit_cast<std::uint64_t>(one));
      ASSERT_EQ(std::bit_cast<std::uint64_t>(s[i]), std::bit_cast<std::uint64_t>(other));
    }
  }
}

// FNV-1a over the bits
std::uint64_t hash_of(std::vector<std::vector<double>> const& arrays) {
  std::uint64_t hash = 14695981039346656037U;
  for (auto const& array : arrays)
    for (double value : array) hash = (hash ^ std::bit_cast<std::uint64_t>(value)) * 1099511628211U;
  return hash;
}

// Not from this machine alone: whoever gets other bits computes other columns
TEST_P(Elementary, GivesTheBitsThatEveryMachineGives) {
  std::vector<std::vector<double>> results;
  for (double const scale : {1.0, 30.0, 700.0}) {
    auto x = spread(-scale, scale);
    std::vector<double> out(n), other(n);
    exponential(x.data(), n, out.data());
    results.push_back(out);
    power_of_size(x.data(), 0.37, n, out.data());
    results.push_back(out);
    cosine_sine_of_multiple(2.3, x.data(), n, out.data(), other.data());
    results.push_back(out);
    results.push_back(other);
  }
  EXPECT_EQ(hash_of(results), 10840216492442288293U);
}

INSTANTIATE_TEST_SUITE_P(Target, Elementary, testing::ValuesIn(supported_instruction_sets()), instruction_set_of);

}  // namespace elementary_test
}  // namespace torquescope::kernels
