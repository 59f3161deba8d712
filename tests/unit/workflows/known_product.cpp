// Products of numbers and quantities, and quantities that differ by their unit alone.

#include "engine/experiment/known_product.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "engine/experiment/quantity_unit.hpp"

namespace torquescope {
namespace known_product_test {

using testing::ElementsAre;
using testing::HasSubstr;

std::string fault_of(std::string const& text) {
  KnownProduct product;
  return read_product(text, product);
}

TEST(KnownProduct, MultipliesNumbersAndQuantities) {
  KnownProduct product;
  ASSERT_EQ(read_product("9.5 * mass_kg *length_m*2", product), "");
  EXPECT_THAT(product.names, ElementsAre("mass_kg", "length_m"));
  EXPECT_DOUBLE_EQ(value_of_product(product, {{"mass_kg", 0.5}, {"length_m", 0.25}}), 9.5 * 0.5 * 0.25 * 2);
  EXPECT_EQ(product_with(product, "length_m", "0.001 * length_mm"), "9.5 * mass_kg * 0.001 * length_mm * 2");
}

TEST(KnownProduct, IsNoLanguage) {
  EXPECT_EQ(fault_of(""), "it is empty");
  EXPECT_EQ(fault_of("a * "), "a factor is missing beside a *");
  EXPECT_EQ(fault_of("a ** b"), "a factor is missing beside a *");
  EXPECT_THAT(fault_of("a / b"), HasSubstr("\"/\" is not understood"));
  EXPECT_THAT(fault_of("2 * (a + b)"), HasSubstr("\"(\" is not understood"));
  EXPECT_THAT(fault_of("length_m^2"), HasSubstr("\"^\" is not understood"));
}

TEST(KnownProduct, TakesFiniteNumbersAlone) {
  double value = 0.0;
  EXPECT_TRUE(read_number("-2.5e-3", value));
  EXPECT_EQ(value, -2.5e-3);
  for (auto const* text : {"", "1 ", "inf", "nan", "1e999", "0x10", "12V"})
    EXPECT_FALSE(read_number(text, value)) << text;
}

TEST(QuantityUnit, TellsTheFactorOfOneQuantityInTwoUnits) {
  EXPECT_DOUBLE_EQ(factor_between("length_m", "length_mm").value(), 1e-3);
  EXPECT_DOUBLE_EQ(factor_between("load_mass_kg", "load_mass_g").value(), 1e-3);
  EXPECT_DOUBLE_EQ(factor_between("supply_mV", "supply_v").value(), 1e3);
  EXPECT_FALSE(factor_between("length_m", "width_mm"));
  EXPECT_FALSE(factor_between("length_m", "length_kg"));
  EXPECT_FALSE(factor_between("length_m", "length_m"));
  EXPECT_FALSE(factor_between("length", "length_mm"));
}

}  // namespace known_product_test
}  // namespace torquescope
