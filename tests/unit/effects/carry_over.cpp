// What effects of the catalogue say of a recording that they were not fitted to.

#include "engine/effects/carry_over.hpp"

#include <gtest/gtest.h>

#include <string>

namespace torquescope {
namespace carry_over_test {

CarryOver of(std::string const& name) {
  auto const* effect = find_effect(name);
  EXPECT_NE(effect, nullptr) << name;
  return carry_over(*effect);
}

TEST(CarriedOver, WholeAreEffectsOfTheMotion) {
  for (auto const* name : {"spring", "stribeck", "delay", "presliding"}) EXPECT_EQ(of(name), CarryOver::whole) << name;
}

TEST(CarriedOver, AWaveOverTheTravelMayTurnItsPhase) { EXPECT_EQ(of("cogging"), CarryOver::with_another_phase); }

TEST(CarriedOver, FrictionThatRunsDownIsCarriedInPart) { EXPECT_EQ(of("thermal_friction"), CarryOver::in_part); }

TEST(CarriedOver, NothingOfAnInstantAClockOrADriftingChannel) {
  for (auto const* name : {"contact", "payload_change", "sensor_drift"}) EXPECT_EQ(of(name), CarryOver::none) << name;
}

TEST(CarriedOver, AWavePerSecondKeepsItsFrequency) { EXPECT_EQ(of("periodic_disturbance"), CarryOver::in_frequency); }

TEST(CarriedOver, WhatIsCarriedWholeOrOverACounterIsNotOfAClock) {
  for (auto const* effect : effect_choices()) {
    CarryOver const over = carry_over(*effect);
    EXPECT_EQ(is_clock_bound(*effect), over != CarryOver::whole && over != CarryOver::with_another_phase)
        << effect->name();
  }
}

}  // namespace carry_over_test
}  // namespace torquescope
