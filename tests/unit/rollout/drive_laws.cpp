// Every law of drive and gear keeps what its record promises: a number of its own, starts that a fit may begin at, and
// nothing at all where it begins at zero.

#include <gtest/gtest.h>

#include <set>
#include <string>

#include "engine/simulate/rollout/drive_law.hpp"
#include "unit/rollout/servos.hpp"

using namespace torquescope;
using namespace torquescope::test;

namespace drive_laws_test {

// of a set that says something of every law: two loads, an arm, two temperatures
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

TEST(DriveLaws, HaveANumberAndANameOfTheirOwn) {
  std::set<LoopKey> keys;
  std::set<std::string> names;
  for (DriveLaw const* law : drive_laws()) {
    ASSERT_FALSE(law->keys.empty()) << law->name;
    EXPECT_TRUE(keys.insert(law->keys.front()).second) << law->name;
    EXPECT_TRUE(names.insert(law->name).second) << law->name;
    EXPECT_EQ(&drive_law_of(law->keys.front()), law);
    for (char const* text : {law->title, law->equation, law->confused}) EXPECT_NE(std::string(text), "") << law->name;
  }
  EXPECT_EQ(keys.size(), drive_laws().size());
  // a number that laws share is the own one of none
  for (DriveLaw const* law : drive_laws())
    for (std::size_t k = 1; k < law->keys.size(); ++k) EXPECT_FALSE(keys.contains(law->keys[k])) << law->name;
}

TEST(DriveLaws, StartWithinTheBoundsOfTheirNumbers) {
  for (DriveLaw const* law : drive_laws()) {
    auto const starts = law->starts(all_scales());
    ASSERT_FALSE(starts.empty()) << law->name;
    for (auto const& start : starts) {
      ASSERT_EQ(start.size(), law->keys.size()) << law->name;
      for (std::size_t k = 0; k < start.size(); ++k) {
        auto const& facts = facts_of(law->keys[k]);
        EXPECT_LE(facts.least, start[k]) << law->name;
        EXPECT_LE(start[k], facts.most) << law->name;
      }
      EXPECT_EQ(law->adds, start.front() == facts_of(law->keys.front()).none) << law->name;
    }
  }
}

TEST(DriveLaws, ThatAddBeginWhereNothingChanges) {
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
      for (DriveLaw const* law : drive_laws()) {
        if (!law->adds) continue;
        ++added;
        for (auto const& start : law->starts(all_scales())) {
          LoopValues with = values;
          // what stands already stays
          if (has_gear && law->keys[0] == LoopKey::stribeck_friction) continue;
          with[law->keys[0]] = start[0];
          for (std::size_t k = 1; !has_gear && k < start.size(); ++k) with[law->keys[k]] = start[k];
          EXPECT_TRUE(same_bits(without.position, rolled(track, {}, {trial(with)}).position)) << law->name;
          // and it is a law: elsewhere it changes the motion
          with[law->keys[0]] = law->keys[0] == LoopKey::motor_gain_per_kelvin ? -0.01 : 0.1;
          EXPECT_FALSE(same_bits(without.position, rolled(track, {}, {trial(with)}).position)) << law->name;
        }
      }
      EXPECT_EQ(added, 7);
    }
  }
}

TEST(DriveLaws, StayOutWhereRecordingsSayNothingOfThem) {
  auto tracks = set_of_recordings();
  DriveScales const all = all_scales();
  EXPECT_TRUE(all.has_load && all.has_several_loads && all.has_arm && all.has_temperatures);
  tracks[1].known = tracks[0].known;
  DriveScales const one_load = drive_scales(tracks, proportional());
  EXPECT_TRUE(one_load.has_load);
  EXPECT_FALSE(one_load.has_several_loads || one_load.has_arm || one_load.has_temperatures);
  EXPECT_TRUE(drive_law_of(LoopKey::arm_mass).starts(one_load).empty());
  EXPECT_TRUE(drive_law_of(LoopKey::motor_gain_per_kelvin).starts(one_load).empty());
  EXPECT_FALSE(drive_law_of(LoopKey::load_friction).starts(one_load).empty());
  for (auto& track : tracks) track.known = {};
  DriveScales const none = drive_scales(tracks, proportional());
  for (LoopKey const key : {LoopKey::load_friction, LoopKey::load_square_friction, LoopKey::load_stribeck_friction})
    EXPECT_TRUE(drive_law_of(key).starts(none).empty());
  EXPECT_FALSE(drive_law_of(LoopKey::stribeck_friction).starts(none).empty());
  // a weight that the model fits loads the gear as a known one does
  DriveScales const fitted = drive_scales(tracks, proportional(), true);
  EXPECT_FALSE(drive_law_of(LoopKey::load_friction).starts(fitted).empty());
  EXPECT_TRUE(drive_law_of(LoopKey::arm_mass).starts(fitted).empty());
}

// sizes by hand: a sine of one radian at one hertz, whose command is clipped at the lower of two limits
TEST(DriveLaws, MeasureASetByItsOwnSizes) {
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

}  // namespace drive_laws_test
