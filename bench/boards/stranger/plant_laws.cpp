// Laws of the stranger's plant: energy, step halving, and that a case is the same each time it is made.
#include <gtest/gtest.h>

#include <cmath>

#include "stranger/plant.hpp"
#include "stranger/recording.hpp"

namespace stranger {
namespace {

double rms_difference(std::vector<Sample> const& a, std::vector<Sample> const& b) {
  double sum = 0;
  for (std::size_t k = 0; k < a.size(); ++k) sum += (a[k].torque - b[k].torque) * (a[k].torque - b[k].torque);
  return std::sqrt(sum / static_cast<double>(a.size()));
}

Case named(std::string const& name) {
  for (auto const& each : all_cases())
    if (each.name == name) return each;
  throw std::runtime_error("no case " + name);
}

TEST(StrangersPlant, GivesWhatTheMotorDoesToMotionAndFriction) {
  std::vector<std::unique_ptr<Effect>> nothing;
  Plant plant{find_rig("belt"), nothing};
  double const start = plant.kinetic_energy();
  for (int k = 0; k < 200000; ++k) plant.step(30 * std::sin(6e-5 * k) + 12 * std::sin(9.1e-4 * k), 0, 2.5e-5);
  double const balance = plant.driven_energy() - plant.lost_energy() - (plant.kinetic_energy() - start);
  EXPECT_GT(plant.lost_energy(), 1.0);
  EXPECT_NEAR(balance, 0, 1e-3 * plant.driven_energy());
}

TEST(StrangersPlant, StaysAtRestBelowTheDryLevel) {
  std::vector<std::unique_ptr<Effect>> nothing;
  Rig const rig = find_rig("pan");
  Plant plant{rig, nothing};
  for (int k = 0; k < 1000; ++k) plant.step(rig.offset + 0.99 * rig.dry_forward, 0, 1e-4);
  EXPECT_EQ(plant.speed(), 0.0);
  EXPECT_EQ(plant.angle(), rig.centre);
  plant.step(rig.offset + 1.01 * rig.dry_forward, 0, 1e-4);
  EXPECT_GT(plant.speed(), 0.0);
}

// what rounding in the encoder makes of the smallest difference is noise of the loop, not of the integrator
TEST(StrangersPlant, HalvingTheStepChangesTheTorqueByLessThanItsNoise) {
  for (char const* name : {"clean_gear_creep", "presliding", "backlash", "joint_elasticity", "end_stop"}) {
    Case each = named(name);
    each.train_s = 6;
    each.instruments.counts_per_unit *= 1e5;
    Options coarse;
    Options fine;
    fine.steps_per_tick = 2 * coarse.steps_per_tick;
    double const noise = each.instruments.white * find_rig(each.rig).torque_rms;
    EXPECT_LT(rms_difference(record(each, false, coarse), record(each, false, fine)), noise) << name;
  }
}

TEST(StrangersCases, AreTheSameEachTime) {
  Case each = named("cogging");
  each.train_s = 2;
  EXPECT_EQ(rms_difference(record(each, false, {}), record(each, false, {})), 0.0);
}

TEST(StrangersCases, CleanOnesConcealNothing) {
  for (auto const& each : all_cases()) EXPECT_EQ(each.laws.empty(), each.kind == "clean") << each.name;
}

}  // namespace
}  // namespace stranger
