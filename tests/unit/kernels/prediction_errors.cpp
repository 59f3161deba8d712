// Samples side by side lose on every instruction set the same bits of their past as one after the other.

#include "kernels/prediction_errors.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "unit/kernels/every_instruction_set.hpp"

namespace torquescope::kernels {
namespace prediction_errors_test {

class PredictionErrors : public EveryInstructionSet {};

// the documented sum
double told_by_past(std::vector<double> const& past, std::vector<double> const& x, std::size_t k) {
  double part[4] = {0.0, 0.0, 0.0, 0.0};
  std::size_t const in_fours = past.size() - past.size() % 4;
  for (std::size_t i = 0; i < past.size(); ++i) part[i < in_fours ? i % 4 : 0] += past[i] * x[k - 1 - i];
  return (part[0] + part[1]) + (part[2] + part[3]);
}

TEST_P(PredictionErrors, AreThoseOfTheDocumentedSum) {
  for (std::size_t order : {0, 1, 3, 4, 5, 30, 48})
    for (std::size_t n : {0, 1, 2, 7, 8, 9, 40, 211}) {
      std::vector<double> past(order), x(order + n + 8);
      for (std::size_t i = 0; i < order; ++i)
        past[i] = std::cos(0.7 * static_cast<double>(i)) / static_cast<double>(i + 2);
      for (std::size_t k = 0; k < x.size(); ++k) x[k] = std::sin(0.3 * static_cast<double>(k * k % 97));
      std::vector<double> expected = x;
      for (std::size_t k = order; k < order + n; ++k) expected[k] = 0.3 * (x[k] - told_by_past(past, x, k));
      take_prediction_errors(past.data(), order, 0.3, x.data() + order, n);
      ASSERT_EQ(x, expected) << order << " samples of past, " << n << " to change";
    }
}

TEST_P(PredictionErrors, BeginAStretchWithWhatPastThereIs) {
  for (std::size_t samples : {0, 1, 2, 8, 30, 48, 61}) {
    std::vector<std::vector<double>> past(samples);
    std::vector<double> gain(samples), x(samples);
    for (std::size_t m = 0; m < samples; ++m) {
      for (std::size_t i = 0; i < m; ++i) past[m].push_back(std::cos(0.7 * static_cast<double>(i * m)));
      gain[m] = 0.3 + 0.01 * static_cast<double>(m);
      x[m] = std::sin(0.3 * static_cast<double>(m * m % 97));
    }
    FirstPredictionErrors const take_errors(past, gain);
    for (std::size_t n = 0; n <= samples; ++n) {
      std::vector<double> expected = x, found = x;
      for (std::size_t m = 0; m < n; ++m) expected[m] = gain[m] * (x[m] - told_by_past(past[m], x, m));
      take_errors.take(found.data(), n);
      ASSERT_EQ(found, expected) << n << " of " << samples;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Target, PredictionErrors, testing::ValuesIn(supported_instruction_sets()), instruction_set_of);

}  // namespace prediction_errors_test
}  // namespace torquescope::kernels
