// Numbers in sentences: few digits, no exponent in everyday sizes, and a p-value is never zero.

#include "engine/base/quantity_text.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace torquescope {
namespace quantity_text_test {

TEST(QuantityText, HasTwoDigitsAndNoExponentInEverydaySizes) {
  EXPECT_EQ(two_digits(0.3541), "0.35");
  EXPECT_EQ(two_digits(-12.4), "-12");
  EXPECT_EQ(two_digits(152.0), "150");
  EXPECT_EQ(two_digits(0.0), "0");
  EXPECT_EQ(two_digits(0.0996), "0.10");
  EXPECT_EQ(two_digits(99.7), "100");
  EXPECT_EQ(two_digits(3.2e-9), "3.2e-09");
  EXPECT_EQ(two_digits(std::numeric_limits<double>::quiet_NaN()), "?");
}

TEST(QuantityText, SmallLengthsAnglesAndTimesTakeAMilli) {
  EXPECT_EQ(quantity_text(0.0038, "s"), "3.8 ms");
  EXPECT_EQ(quantity_text(0.0002, "rad"), "0.20 mrad");
  EXPECT_EQ(quantity_text(0.12, "rad/s"), "0.12 rad/s");
  EXPECT_EQ(quantity_text(0.002, "N m"), "0.0020 N m");
  EXPECT_EQ(quantity_text(0.5, "1"), "0.50");
}

TEST(QuantityText, TwoEndsOfAnIntervalAreToldApart) {
  EXPECT_EQ(between_text(0.4, 0.9, "rad"), "between 0.40 and 0.90 rad");
  EXPECT_EQ(between_text(-0.1791, -0.1702, "rad/s"), "between -0.179 and -0.170 rad/s");
  EXPECT_EQ(between_text(18.93, 19.31, "s"), "between 18.9 and 19.3 s");
  EXPECT_EQ(between_text(0.3004, 0.3041, "m"), "between 0.300 and 0.304 m");
  EXPECT_EQ(between_text(0.002, 0.0041, "m"), "between 2.0 and 4.1 mm");
  EXPECT_EQ(between_text(0.008, 0.012, "m"), "between 8.0 mm and 0.012 m");
  EXPECT_EQ(between_text(5.0, 12.0, ""), "between 5.0 and 12");
  EXPECT_EQ(between_text(0.0, 152.0, "Hz"), "between 0 and 150 Hz");
}

TEST(QuantityText, SharesAreSaidInPercent) {
  EXPECT_EQ(percent_text(0.1213), "12.1 %");
  EXPECT_EQ(percent_text(0.00562), "0.56 %");
  EXPECT_EQ(percent_text(0.0), "0.0 %");
  EXPECT_EQ(percent_text(std::nan("")), "?");
}

TEST(QuantityText, AShareHasTwoDigitsAndAnUnknownOneNone) {
  EXPECT_EQ(share_text(0.7131), "71 %");
  EXPECT_EQ(share_text(0.04), "4.0 %");
  EXPECT_EQ(share_text(std::nan("")), "");
}

TEST(QuantityText, ProbabilitiesAreNeverZeroNorMoreExactThanTheReplicates) {
  double const least = 1.0 / 201.0;
  EXPECT_EQ(p_text(least, least), "p < 0.005");
  EXPECT_EQ(p_text(1e-9, least), "p < 0.005");  // a tail that was continued beyond the replicates
  EXPECT_EQ(p_text(0.0, 0.0), "p < 0.000001");
  EXPECT_EQ(p_text(0.4129, least), "p = 0.41");
  EXPECT_EQ(p_text(0.0149, least), "p = 0.015");
  EXPECT_EQ(p_text(1.0 / 61.0, 1.0 / 61.0), "p < 0.02");
  EXPECT_EQ(p_cell(0.0149, least), "0.015");
  EXPECT_EQ(p_cell(least, least), "<0.005");  // no replicate reached it: at most this
}

}  // namespace quantity_text_test
}  // namespace torquescope
