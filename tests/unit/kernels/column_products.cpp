// Inner products of columns on every instruction set: the documented order of addition, bit by bit.

#include "kernels/column_products.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

#include "kernels/lane_sum.hpp"
#include "unit/kernels/every_instruction_set.hpp"

namespace torquescope::kernels {
namespace column_products_test {

std::vector<double> columns(std::size_t n, std::size_t count, double phase) {
  std::vector<double> x(n * count);
  for (std::size_t i = 0; i < x.size(); ++i) x[i] = std::sin(phase + 1.3 * static_cast<double>(i * i % 1009));
  return x;
}

double documented(double const* a, double const* b, std::size_t n) {
  std::array<double, n_lanes> lanes{};
  for (std::size_t row = 0; row < n; ++row) lanes[row % n_lanes] = std::fma(a[row], b[row], lanes[row % n_lanes]);
  return sum_lanes(lanes.data());
}

class ColumnProducts : public EveryInstructionSet {};

TEST_P(ColumnProducts, AreSummedInTheDocumentedOrderWhateverTheCompany) {
  for (std::size_t n : {0, 1, 7, 8, 9, 100})
    for (std::size_t n_a : {0, 1, 2, 3, 4, 5, 9})
      for (std::size_t n_b : {0, 1, 2, 3, 4, 5, 9}) {
        auto const a = columns(n, n_a, 0.1), b = columns(n, n_b, 0.7);
        std::vector<double> out(n_a * n_b, -1.0);
        column_products({a.data(), n_a, n}, {b.data(), n_b, n}, n, out.data());
        for (std::size_t i = 0; i < n_a; ++i)
          for (std::size_t j = 0; j < n_b; ++j)
            ASSERT_EQ(out[i + j * n_a], documented(a.data() + i * n, b.data() + j * n, n))
                << n << " rows, column " << i << " of " << n_a << ", " << j << " of " << n_b;
      }
}

TEST_P(ColumnProducts, OfSomeRowsAreThoseOfTheRowsAlone) {
  constexpr std::size_t n = 100, first = 13, rows = 41, n_a = 5, n_b = 3;
  auto const a = columns(n, n_a, 0.1), b = columns(n, n_b, 0.7);
  std::vector<double> out(n_a * n_b, -1.0);
  column_products({a.data() + first, n_a, n}, {b.data() + first, n_b, n}, rows, out.data());
  for (std::size_t i = 0; i < n_a; ++i)
    for (std::size_t j = 0; j < n_b; ++j)
      ASSERT_EQ(out[i + j * n_a], documented(a.data() + first + i * n, b.data() + first + j * n, rows));
}

INSTANTIATE_TEST_SUITE_P(Target, ColumnProducts, testing::ValuesIn(supported_instruction_sets()), instruction_set_of);

}  // namespace column_products_test
}  // namespace torquescope::kernels
