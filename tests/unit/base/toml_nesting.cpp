#include "engine/base/toml_nesting.hpp"

#include <gtest/gtest.h>

namespace torquescope {
namespace toml_nesting_test {

TEST(TomlNesting, CountsBracketsBracesAndDotsOfOneKey) {
  EXPECT_EQ(first_too_deep("x = [[1]]", 2), std::nullopt);
  EXPECT_EQ(first_too_deep("x = [[[1]]]", 2), 6u);
  EXPECT_EQ(first_too_deep("x = {a = {b = {c = 1}}}", 2), 14u);
  EXPECT_EQ(first_too_deep("a.b.c = 1", 2), std::nullopt);
  EXPECT_EQ(first_too_deep("a.b.c.d = 1", 2), 5u);
  EXPECT_EQ(first_too_deep("x = {a.b.c = 1}", 2), 8u);
}

TEST(TomlNesting, ForgetsWhatWasClosed) {
  EXPECT_EQ(first_too_deep("x = [1]\ny = [2]\nz = [3]\n", 1), std::nullopt);
  EXPECT_EQ(first_too_deep("x = [0.5, 1.5, 2.5, 3.5]", 2), std::nullopt);
}

TEST(TomlNesting, IsBlindInTextsAndComments) {
  EXPECT_EQ(first_too_deep("x = \"[[[[\" # [[[[\n", 0), std::nullopt);
  EXPECT_EQ(first_too_deep("x = '[[[[' ", 0), std::nullopt);
  EXPECT_EQ(first_too_deep("x = \"\\\"[[[[\"", 0), std::nullopt);
  EXPECT_EQ(first_too_deep("x = \"\"\"\n[[[[\"[[\n\"\"\"", 0), std::nullopt);
}

TEST(TomlNesting, AnOpenQuoteHidesNothingBelowItsLine) {
  EXPECT_NE(first_too_deep("x = \"open\ny = [[[[[", 4), std::nullopt);
}

}  // namespace toml_nesting_test
}  // namespace torquescope
