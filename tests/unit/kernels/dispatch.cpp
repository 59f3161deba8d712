#include "kernels/dispatch.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

namespace torquescope::kernels {
namespace dispatch_test {

class Dispatch : public testing::Test {
 protected:
  void TearDown() override { release_instruction_set(); }
};

TEST_F(Dispatch, ChoosesTheBestSupportedInstructionSet) {
  ASSERT_FALSE(supported_instruction_sets().empty());
  EXPECT_EQ(instruction_set(), supported_instruction_sets().front());
}

TEST_F(Dispatch, ForcesEverySupportedInstructionSet) {
  for (auto const name : supported_instruction_sets()) {
    EXPECT_TRUE(force_instruction_set(name));
    EXPECT_EQ(instruction_set(), name);
  }
}

TEST_F(Dispatch, ForcingDoesNotChangeWhatIsSupported) {
  auto const before = supported_instruction_sets();
  ASSERT_TRUE(force_instruction_set(before.back()));
  EXPECT_EQ(supported_instruction_sets(), before);
}

TEST_F(Dispatch, ReleasingReturnsToTheBest) {
  ASSERT_TRUE(force_instruction_set(supported_instruction_sets().back()));
  release_instruction_set();
  EXPECT_EQ(instruction_set(), supported_instruction_sets().front());
}

TEST_F(Dispatch, RefusesAnUnknownNameAndKeepsTheChoice) {
  auto const chosen = supported_instruction_sets().back();
  ASSERT_TRUE(force_instruction_set(chosen));
  EXPECT_FALSE(force_instruction_set("avx-1024"));
  EXPECT_FALSE(force_instruction_set(""));
  EXPECT_EQ(instruction_set(), chosen);
}

TEST_F(Dispatch, KnowsWhichInstructionSetsHaveFusedMultiplyAdd) {
  for (auto const name : supported_instruction_sets()) {
    ASSERT_TRUE(force_instruction_set(name));
    bool const is_old_x86 = name.starts_with("SS") || name == "SCALAR" || name == "EMU128";
    EXPECT_EQ(instruction_set_has_fma(), !is_old_x86) << name;
  }
}

#if defined(__x86_64__)
// what a machine without any of the others runs on, and the oracle for them in tests
TEST_F(Dispatch, AlwaysHasPlainCode) {
  EXPECT_THAT(supported_instruction_sets().back(), testing::AnyOf("SCALAR", "EMU128"));
}
#endif

}  // namespace dispatch_test
}  // namespace torquescope::kernels
