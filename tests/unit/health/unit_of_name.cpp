// Units that names tell, and names that tell none.

#include "engine/data/unit_of_name.hpp"

#include <gtest/gtest.h>

namespace torquescope {
namespace unit_of_name_test {

TEST(UnitOfName, IsTheLastWordOrStandsInBrackets) {
  struct Named {
    char const* column;
    char const* word;
    double si;
  };
  for (auto const& named :
       {Named{"q_deg", "deg", 0.017453292519943295}, Named{"t [ms]", "ms", 1e-3},
        Named{"Position (Inc)", "counts", 1.0}, Named{"i_mA", "mA", 1e-3},
        Named{"omega_rpm", "rpm", 0.10471975511965977}, Named{"torque_permille", "per mille", 1e-3},
        Named{"joint/q1_rad", "rad", 1.0}, Named{"dq_rad_s", "rad/s", 1.0}, Named{"tau_Nm", "N m", 1.0}}) {
    auto const unit = unit_of_name(named.column);
    ASSERT_TRUE(unit) << named.column;
    EXPECT_EQ(unit->word, named.word) << named.column;
    EXPECT_DOUBLE_EQ(unit->si, named.si) << named.column;
  }
}

TEST(UnitOfName, OneWordTellsNothing) {
  for (auto const* column : {"q", "m", "position", "tau", "s", "current", "q1", "joint.v", "effort"})
    EXPECT_FALSE(unit_of_name(column)) << column;
  EXPECT_EQ(unit_of_name("angle", "[deg]")->word, "deg");
  EXPECT_EQ(unit_of_name("angle", "rad/s")->word, "rad/s");
}

}  // namespace unit_of_name_test
}  // namespace torquescope
