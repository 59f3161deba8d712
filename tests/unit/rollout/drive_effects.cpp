// Every effect of drive and gear keeps what its record promises: a number of its own, starts that a fit may begin at,
// and nothing at all where it begins at zero.

#include <gtest/gtest.h>

#include <set>
#include <string>

#include "engine/simulate/rollout/drive_effect.hpp"
#include "unit/rollout/servos.hpp"

using namespace torquescope;
using namespace torquescope::test;

namespace drive_effects_test {

// of a set that says something of every effect: two loads, an arm, two temperatures
std::vector<RolloutTrack> set_of_recordings() {
  PlainInputs in;
  in.rate_hz = 100.0;
  in.ticks_per_sample = 5;
  in.reference = servo_goals(300, in.rate_hz);
  PlainServo servo;
  std::vector<RolloutTrack> tracks;
  for (double const mass : {0.5, 1.0}) {
    servo.weight = 9.80665 * mass * 0.15;
    PlainMotion const motion{run_servo(servo, in, {}).position, {}, {}};
    tracks.push_back(track_of(in, {}, motion));
    tracks.back().known = {servo.weight, 0.0225 * mass, 60.0, 12.0, 0.15, mass > 0.6 ? 45.0 : 28.0};
    tracks.back().encoder_step = 1.5e-3;
  }
  return tracks;
}

LoopNumbers proportional() {
  LoopNumbers loop;
  loop.kp = 1.0;
  loop.motor_gain = 0.25;
  return loop;
}

DriveScales all_scales() { return drive_scales(set_of_recordings(), proportional()); }

TEST(DriveEffects, HaveANumberAndANameOfTheirOwn) {
  std::set<LoopKey> keys;
  std::set<std::string> names;
  for (DriveEffect const* effect : drive_effects()) {
    ASSERT_FALSE(effect->keys.empty()) << effect->name;
    EXPECT_TRUE(keys.insert(effect->keys.front()).second) << effect->name;
    EXPECT_TRUE(names.insert(effect->name).second) << effect->name;
    EXPECT_EQ(&drive_effect_of(effect->keys.front()), effect);
    for (char const* text : {effect->title, effect->equation, effect->confused})
      EXPECT_NE(std::string(text), "") << effect->name;
  }
  EXPECT_EQ(keys.size(), drive_effects().size());
  // a number that effects share is the own one of none
  for (DriveEffect const* effect : drive_effects())
    for (std::size_t k = 1; k < effect->keys.size(); ++k) EXPECT_FALSE(keys.contains(effect->keys[k])) << effect->name;
}

TEST(DriveEffects, StartWithinTheBoundsOfTheirNumbers) {
  for (DriveEffect const* effect : drive_effects()) {
    auto const starts = effect->starts(all_scales());
    ASSERT_FALSE(starts.empty()) << effect->name;
    for (auto const& start : starts) {
      ASSERT_EQ(start.size(), effect->keys.size()) << effect->name;
      for (std::size_t k = 0; k < start.size(); ++k) {
        auto const& facts = facts_of(effect->keys[k]);
        EXPECT_LE(facts.least, start[k]) << effect->name;
        EXPECT_LE(start[k], facts.most) << effect->name;
      }
      EXPECT_EQ(effect->adds, start.front() == facts_of(effect->keys.front()).none) << effect->name;
    }
  }
}

TEST(DriveEffects, ThatAddBeginWhereNothingChanges) {
  auto tracks = set_of_recordings();
  PlainServo servo;
  servo.load = 0.1;
  for (bool const has_gear : {false, true}) {
    if (!has_gear) servo.load = 0.0;
    LoopValues values;
    values[LoopKey::kp] = 1.0;
    values[LoopKey::motor_gain] = 0.25;
    values[LoopKey::back_emf] = servo.back_emf;
    if (has_gear) values[LoopKey::stribeck_friction] = 0.05;
    auto const trial = [&](LoopValues const& of) {
      RolloutTrial made = trial_of(servo);
      made.loop = numbers_of(LoopForm::p, of);
      made.gear = gear_of(of);
      made.arm_mass = of[LoopKey::arm_mass];
      made.motor_gain_per_kelvin = of[LoopKey::motor_gain_per_kelvin];
      return made;
    };
    for (auto const& track : tracks) {
      Rolled const without = rolled(track, {}, {trial(values)});
      int added = 0;
      for (DriveEffect const* effect : drive_effects()) {
        if (!effect->adds) continue;
        ++added;
        for (auto const& start : effect->starts(all_scales())) {
          LoopValues with = values;
          // what stands already stays
          if (has_gear && effect->keys[0] == LoopKey::stribeck_friction) continue;
          with[effect->keys[0]] = start[0];
          for (std::size_t k = 1; !has_gear && k < start.size(); ++k) with[effect->keys[k]] = start[k];
          EXPECT_TRUE(same_bits(without.position, rolled(track, {}, {trial(with)}).position)) << effect->name;
          // and it is an effect: elsewhere it changes the motion
          with[effect->keys[0]] = effect->keys[0] == LoopKey::motor_gain_per_kelvin ? -0.01 : 0.1;
          EXPECT_FALSE(same_bits(without.position, rolled(track, {}, {trial(with)}).position)) << effect->name;
        }
      }
      EXPECT_EQ(added, 7);
    }
  }
}

TEST(DriveEffects, StayOutWhereRecordingsSayNothingOfThem) {
  auto tracks = set_of_recordings();
  DriveScales const all = all_scales();
  EXPECT_TRUE(all.has_load && all.has_several_loads && all.has_arm && all.has_temperatures);
  tracks[1].known = tracks[0].known;
  DriveScales const one_load = drive_scales(tracks, proportional());
  EXPECT_TRUE(one_load.has_load);
  EXPECT_FALSE(one_load.has_several_loads || one_load.has_arm || one_load.has_temperatures);
  EXPECT_TRUE(drive_effect_of(LoopKey::arm_mass).starts(one_load).empty());
  EXPECT_TRUE(drive_effect_of(LoopKey::motor_gain_per_kelvin).starts(one_load).empty());
  EXPECT_FALSE(drive_effect_of(LoopKey::load_friction).starts(one_load).empty());
  for (auto& track : tracks) track.known = {};
  DriveScales const none = drive_scales(tracks, proportional());
  for (LoopKey const key : {LoopKey::load_friction, LoopKey::load_square_friction, LoopKey::load_stribeck_friction})
    EXPECT_TRUE(drive_effect_of(key).starts(none).empty());
  EXPECT_FALSE(drive_effect_of(LoopKey::stribeck_friction).starts(none).empty());
  // a weight that the model fits loads the gear as a known one does
  DriveScales const fitted = drive_scales(tracks, proportional(), true);
  EXPECT_FALSE(drive_effect_of(LoopKey::load_friction).starts(fitted).empty());
  EXPECT_TRUE(drive_effect_of(LoopKey::arm_mass).starts(fitted).empty());
}

// sizes by hand: a sine of one radian at one hertz, whose command is clipped at the lower of two limits
TEST(DriveEffects, MeasureASetByItsOwnSizes) {
  constexpr double turn = 2.0 * std::numbers::pi, rate_hz = 200.0;
  RolloutTrack track;
  track.rate_hz = rate_hz;
  track.position = track.reference = Eigen::VectorXd::Zero(1000);
  for (Eigen::Index k = 0; k < 1000; ++k) {
    track.position[k] = std::sin(turn * static_cast<double>(k) / rate_hz);
    track.reference[k] = track.position[k] + 0.1;
  }
  track.segments = {{0, 1000}};
  track.known.command_gain = 50.0;
  track.known.command_limit = 3.0;
  DriveScales const scales = drive_scales({track}, proportional());
  // differences over a twentieth of a second see sin(x) / x of the speed, x = turn / 20, and its square of what bends
  double const seen = std::sin(turn / 20.0) / (turn / 20.0);
  EXPECT_NEAR(scales.speed, turn * seen, 0.005 * turn);
  EXPECT_NEAR(scales.acceleration, turn * turn, 0.02 * turn * turn);
  EXPECT_NEAR(scales.error, 0.1, 1e-12);
  EXPECT_NEAR(scales.command, 3.0, 1e-12);
  EXPECT_NEAR(scales.torque, 0.75, 1e-12);
  EXPECT_EQ(scales.sample_s, 1.0 / rate_hz);
}

}  // namespace drive_effects_test
