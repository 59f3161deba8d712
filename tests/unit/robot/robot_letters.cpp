// One wrong letter in a URDF or an MJCF changes no arm in silence: it is refused, or warned of with its line.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cctype>
#include <string>

#include "engine/base/random_stream.hpp"
#include "engine/robot/robot_registry.hpp"
#include "support/temporary_folder.hpp"
#include "unit/robot/small_robots.hpp"

namespace torquescope {
namespace robot_letters_test {

struct Outcome {
  bool is_refused = false;
  SerialChain chain{};
};

Outcome read(std::string const& text, RobotPart const& part) {
  test::TemporaryFolder const folder;
  try {
    return {false, read_robot(folder.write("robot.urdf", text), part)};
  } catch (Error const&) {
    return {true, {}};
  }
}

// all numbers of an arm. A name may be any name, but it decides the order in which masses of fixed links are added
bool is_same_arm(SerialChain const& one, SerialChain const& other) {
  if (one.joints.size() != other.joints.size() || one.links.size() != other.links.size()) return false;
  bool is_same = one.gravity == other.gravity && one.flange.position == other.flange.position &&
                 one.flange.rotation == other.flange.rotation && one.base.position == other.base.position &&
                 one.base.rotation == other.base.rotation;
  for (std::size_t i = 0; i < one.joints.size(); ++i) {
    auto const &a = one.joints[i], &b = other.joints[i];
    is_same = is_same && a.kind == b.kind && a.a == b.a && a.alpha == b.alpha && a.d == b.d && a.offset == b.offset &&
              a.lower == b.lower && a.upper == b.upper && a.max_speed == b.max_speed && a.max_torque == b.max_torque &&
              a.drive_inertia == b.drive_inertia && a.gear_ratio == b.gear_ratio;
  }
  for (std::size_t i = 0; i < one.links.size(); ++i)
    is_same = is_same && one.links[i].vector().isApprox(other.links[i].vector(), 1e-12);
  return is_same;
}

void expect_no_silence(std::string const& text, RobotPart const& part, std::uint32_t seed, int draws) {
  auto const sound = read(text, part);
  ASSERT_FALSE(sound.is_refused);
  ASSERT_THAT(sound.chain.warnings, testing::IsEmpty());
  RandomStream random({seed, 0, RandomDomain::test}, 0, 0);
  for (int draw = 0; draw < draws; ++draw) {
    auto flipped = text;
    std::size_t at = 0;
    do at = static_cast<std::size_t>(random.below(static_cast<std::uint32_t>(text.size())));
    while (std::isalpha(static_cast<unsigned char>(text[at])) == 0);
    char letter = text[at];
    while (letter == text[at]) letter = static_cast<char>('a' + random.below(26));
    flipped[at] = letter;
    auto const found = read(flipped, part);
    bool const is_told = found.is_refused || !found.chain.warnings.empty();
    EXPECT_TRUE(is_told || is_same_arm(sound.chain, found.chain))
        << text.substr(text.rfind('\n', at) + 1, 100) << " with " << letter << " for " << text[at];
  }
}

TEST(UrdfLetters, NoneChangesAnArmInSilence) {
  expect_no_silence(test::six_joint_urdf(), {}, 1, 100);
  expect_no_silence(test::hand_urdf(), {"", "hand"}, 2, 100);
  expect_no_silence(test::quadruped_urdf(), {"trunk", "FL_foot"}, 3, 100);
}

TEST(MjcfLetters, NoneChangesAnArmInSilence) {
  expect_no_silence(test::hand_mjcf(), {"", "hand"}, 4, 100);
  expect_no_silence(test::seven_joint_mjcf(), {}, 5, 100);
  expect_no_silence(test::jaw_mjcf(), {}, 6, 100);
  expect_no_silence(test::quadruped_mjcf(), {"trunk", "RL_calf"}, 7, 100);
}

}  // namespace robot_letters_test
}  // namespace torquescope
