// What the names of recordings tell, and the pattern that takes exactly them.

#include "engine/workflows/drafts/name_parts.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "engine/experiment/file_pattern.hpp"
#include "engine/workflows/drafts/name_fields.hpp"
#include "engine/workflows/drafts/name_pattern.hpp"
#include "engine/workflows/drafts/name_quantity.hpp"

namespace torquescope {
namespace name_parts_test {

using Texts = std::map<std::string, std::string>;
using Names = std::vector<std::string>;

// "" where the names share none; the pattern gives back what the names were taken apart to
std::string pattern(Names const& names) {
  auto const parts = parts_of_names(names);
  if (!parts) return "";
  std::string const made = pattern_of(*parts);
  EXPECT_EQ(fault_of_pattern(made), "") << made;
  for (std::size_t k = 0; k < names.size(); ++k) {
    auto const texts = match_name(made, names[k]);
    EXPECT_TRUE(texts) << made << " of " << names[k];
    EXPECT_EQ(texts.value_or(Texts{}), parts->values[k]) << made << " of " << names[k];
  }
  return made;
}

TEST(NameParts, NumbersBehindUsualLettersHaveAName) {
  EXPECT_EQ(pattern({"m0.5_l150_kp8_lift_and_drop.csv", "m1_l150_kp32_steps.csv", "m0.75_l150_kp8_two_sines.csv"}),
            "m{mass_kg}_l{length_mm}_kp{kp}_{motion}.csv");
  EXPECT_EQ(pattern({"kp8-L0.15-m1.csv.gz", "kp16-L0.2-m2.csv.gz"}), "kp{kp}-L{length_m}-m{mass_kg}.csv.gz");
  EXPECT_EQ(pattern({"servo_vin12_T25.csv", "servo_vin7.4_T60.csv"}), "servo_vin{supply_v}_T{temperature_c}.csv");
  EXPECT_EQ(pattern({"m1l150kp8.csv", "m2l150kp32.csv"}), "m{mass_kg}l{length_mm}kp{kp}.csv");
}

TEST(NameParts, AUnitBehindTheNumberNamesItAsWell) {
  EXPECT_EQ(pattern({"0.5kg_150mm_12V_x.csv", "1kg_150mm_7.4V_y.csv"}),
            "{mass_kg}kg_{length_mm}mm_{supply_v}V_{motion}.csv");
  EXPECT_EQ(pattern({"sine_m500g.csv", "step_m1000g.csv"}), "{motion}_m{mass_g}g.csv");
}

TEST(NameParts, SizeDecidesWhatLettersMean) {
  EXPECT_EQ(quantity_of_number("m", "", {0.5, 49}), "mass_kg");
  EXPECT_EQ(quantity_of_number("m", "", {0.5, 500}), "");
  EXPECT_EQ(quantity_of_number("l", "", {0.1, 0.2}), "length_m");
  EXPECT_EQ(quantity_of_number("l", "", {100, 200}), "length_mm");
  EXPECT_EQ(quantity_of_number("l", "", {10, 15}), "") << "cm, or a short arm";
  EXPECT_EQ(quantity_of_number("v", "", {1, 2}), "") << "versions";
  EXPECT_EQ(quantity_of_number("t", "", {25, 60}), "") << "a time, a trial";
  EXPECT_EQ(quantity_of_number("", "", {1}), "");
}

TEST(NameParts, WhatNobodyKnowsIsALetter) {
  EXPECT_EQ(pattern({"run1_g2.csv", "run2_g5.csv"}), "run{a}_g{b}.csv");
  EXPECT_EQ(pattern({"sine_001.csv", "step_002.csv"}), "{motion}_{a}.csv");
  auto const parts = parts_of_names({"run1.csv", "run2.csv"});
  ASSERT_TRUE(parts);
  EXPECT_TRUE(parts->quantities.front().is_a_guess);
  EXPECT_EQ(parts->quantities.front().written, "run1");
  EXPECT_EQ(pattern({"m1_mass2_x.csv", "m2_mass3_x.csv"}), "m{mass_kg}_mass{a}_x.csv") << "one name for one number";
}

TEST(NameParts, WordsThatDifferAreTheMotionInAnyOrder) {
  EXPECT_EQ(pattern({"lift_and_drop_m1.csv", "steps_m1.csv"}), "{motion}_m1.csv");
  EXPECT_EQ(pattern({"up_and_down_kp8_test.csv", "lift_and_drop_kp9_test.csv"}), "{motion}_kp{kp}_test.csv");
  EXPECT_EQ(pattern({"left_kp8_sine.csv", "right_kp8_step.csv"}), "{a}_kp8_{motion}.csv");
  EXPECT_EQ(pattern({"xl330_m1_sine.csv", "xl330_m2_step.csv", "sts3215_m1_drop.csv"}), "{a}_m{mass_kg}_{motion}.csv");
  EXPECT_EQ(pattern({"two_sines_1.csv", "steps_2.csv"}), "{motion}.csv") << "or the number would be sines_1";
}

TEST(NameParts, DatesThatDifferAreAnyLetters) {
  std::string const two(2, '?'), day = two + two + "-" + two + "-" + two, time = two + "-" + two + "-" + two;
  EXPECT_EQ(pattern({"2024-01-31_m1_a.csv", "2024-02-03_m2_b.csv"}), day + "_m{mass_kg}_{motion}.csv");
  EXPECT_EQ(pattern({"m1_20240131T101500.csv", "m2_20240203T090000.csv"}), "m{mass_kg}_*.csv");
  EXPECT_EQ(pattern({"m1_2024-01-31_10-15-00_sine.csv", "m2_2024-01-31_11-15-00_two_steps.csv"}),
            "m{mass_kg}_" + day + "_" + time + "_{motion}.csv");
  EXPECT_EQ(pattern({"2024-01-31_m1.csv", "2024-01-31_m2.csv"}), "2024-01-31_m{mass_kg}.csv");
  EXPECT_EQ(pattern({"kp1_sin_sin_26-01-15_10h28m10.csv", "kp2_drop_24-10-26_12h23m42.csv"}),
            "kp{kp}_{motion}_" + two + "-" + two + "-" + two + "_" + two + "h" + two + "m" + two + ".csv");
  EXPECT_EQ(fields_of_name("m20240131").size(), 2u) << "a date, no mass";
  EXPECT_EQ(pattern({"m20245678.csv", "m20245679.csv"}), "m{a}.csv") << "no date";
}

TEST(NameParts, AConstantNumberIsBelievedBesideAnother) {
  EXPECT_EQ(pattern({"m1_l150_x.csv", "m1_l150_y.csv"}), "m{mass_kg}_l{length_mm}_{motion}.csv");
  EXPECT_EQ(pattern({"m1_x.csv", "m1_y.csv"}), "m1_{motion}.csv") << "perhaps motor 1";
  EXPECT_EQ(pattern({"robot2_m1_l150_x.csv", "robot2_m2_l150_x.csv"}), "robot2_m{mass_kg}_l{length_mm}_x.csv");
}

TEST(NameParts, NamesThatShareNothingHaveNone) {
  EXPECT_EQ(pattern({"m1_a.csv", "m2_b.h5"}), "");
  EXPECT_EQ(pattern({"m1_kp8.csv", "m1-kp9.csv"}), "");
  EXPECT_EQ(pattern({"m1.csv", "m1_steps.csv"}), "");
  EXPECT_EQ(pattern({"m1_kp8.csv", "kp9_m2.csv"}), "") << "numbers in another order";
}

TEST(NameParts, LettersOfPatternsAreNone) {
  EXPECT_EQ(pattern({"a{x}_m1_l200.csv", "a{x}_m2_l200.csv"}), "a?x?_m{mass_kg}_l{length_mm}.csv");
}

TEST(NameParts, FixedQuantitiesStandAsTheirValues) {
  auto const parts = parts_of_names({"m0.5_kp8_x.csv", "m1_kp8_y.csv"});
  ASSERT_TRUE(parts);
  EXPECT_EQ(pattern_of(*parts, {{"mass_kg", "0.5"}}), "m0.5_kp{kp}_{motion}.csv");
}

TEST(NameFields, AnEndingBeginsWithALetter) {
  EXPECT_EQ(begin_of_ending("m0.5_a.csv.gz"), 6u);
  EXPECT_EQ(begin_of_ending("m0.5.csv"), 4u);
  EXPECT_EQ(begin_of_ending("m0.5"), 4u);
  EXPECT_EQ(begin_of_ending(".csv"), 4u);
}

}  // namespace name_parts_test
}  // namespace torquescope
