// What a torque in amperes makes of every unit that effects have.

#include "engine/base/torque_unit.hpp"

#include <gtest/gtest.h>

namespace torquescope {
namespace torque_unit_test {

TEST(TorqueUnit, TakesThePlaceOfForceAndMass) {
  EXPECT_EQ(in_torque_unit("N m", "mA"), "mA");
  EXPECT_EQ(in_torque_unit("N m s/rad", "mA"), "mA s/rad");
  EXPECT_EQ(in_torque_unit("N m/rad", "V"), "V/rad");
  EXPECT_EQ(in_torque_unit("kg m2", "A"), "A s2/rad");
  EXPECT_EQ(in_torque_unit("kg m", "A"), "A s2/m");
  EXPECT_EQ(in_torque_unit("kg", "A"), "A s2/m");
  EXPECT_EQ(in_torque_unit("N s/m", "A"), "A s/m");
  EXPECT_EQ(in_torque_unit("(N m)2", "A"), "A2");
}

TEST(TorqueUnit, LeavesWhatHoldsNeither) {
  for (char const* const unit : {"s", "rad/s", "1", "", "Nonsense", "kgf"}) EXPECT_EQ(in_torque_unit(unit, "A"), unit);
  EXPECT_EQ(in_torque_unit("N m s/rad", ""), "N m s/rad");
  EXPECT_EQ(in_torque_unit("kg m2", "N m"), "kg m2");
}

}  // namespace torque_unit_test
}  // namespace torquescope
