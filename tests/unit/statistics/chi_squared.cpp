// Tails of the chi-squared distribution against printed tables (Abramowitz, Stegun 1964, table 26.8).

#include "engine/fit/statistics/chi_squared.hpp"

#include <gtest/gtest.h>

using torquescope::chi_squared_tail;

TEST(ChiSquared, HasThePrintedTails) {
  struct Printed {
    int degrees_of_freedom;
    double statistic, tail;
  };
  for (auto const& one : {Printed{1, 3.84146, 0.05}, Printed{1, 7.87944, 0.005}, Printed{2, 5.99147, 0.05},
                          Printed{2, 10.5966, 0.005}, Printed{3, 7.81473, 0.05}, Printed{4, 14.8602, 0.005},
                          Printed{5, 1.14548, 0.95}, Printed{7, 20.2777, 0.005}, Printed{10, 18.3070, 0.05}})
    EXPECT_NEAR(chi_squared_tail(one.statistic, one.degrees_of_freedom) / one.tail, 1.0, 1e-4)
        << one.degrees_of_freedom;
}

TEST(ChiSquared, WithNothingFreeOrNothingLeftIsNoSurprise) {
  EXPECT_EQ(chi_squared_tail(5.0, 0), 1.0);
  EXPECT_EQ(chi_squared_tail(0.0, 3), 1.0);
}
