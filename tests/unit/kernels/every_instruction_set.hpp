#pragma once
// Runs a test once on each instruction set of this machine.
//
// Use        INSTANTIATE_TEST_SUITE_P(Name, EveryInstructionSet, testing::ValuesIn(supported_instruction_sets()),
//                                     instruction_set_of);

#include <gtest/gtest.h>

#include <string>
#include <string_view>

#include "kernels/dispatch.hpp"

namespace torquescope::kernels {

class EveryInstructionSet : public testing::TestWithParam<std::string_view> {
 protected:
  void SetUp() override { ASSERT_TRUE(force_instruction_set(GetParam())); }
  void TearDown() override { release_instruction_set(); }
};

inline std::string instruction_set_of(testing::TestParamInfo<std::string_view> const& test) {
  return std::string(test.param);
}

}  // namespace torquescope::kernels
