#include "engine/base/error.hpp"

#include <gtest/gtest.h>

namespace torquescope {
namespace error_test {

TEST(ClosestName, FindsSlipsOfTheFinger) {
  std::vector<std::string> const names{"cutoff_hz", "order", "decimate_to_hz"};
  EXPECT_EQ(closest_name("cutof_hz", names), "cutoff_hz");
  EXPECT_EQ(closest_name("odrer", names), "order");
  EXPECT_EQ(closest_name("banana", names), "");
}

TEST(Validate, ThrowsTheProblemOnlyWhenItDoesNotHold) {
  EXPECT_NO_THROW(validate(true, [] { return Problem{ExitCode::io, "never"}; }));
  try {
    validate(false, [] { return Problem{ExitCode::bad_data, "time runs backwards"}; });
    FAIL();
  } catch (Error const& error) {
    EXPECT_EQ(error.code(), ExitCode::bad_data);
    EXPECT_STREQ(error.what(), "time runs backwards");
  }
}

}  // namespace error_test
}  // namespace torquescope
