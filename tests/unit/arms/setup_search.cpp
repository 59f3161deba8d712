// What is wrong with an arm's set-up: every kind is found with its joints and its number, and nothing on a sound arm.

#include "engine/diagnose/arms/setup_search.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <future>
#include <numbers>

#include "engine/diagnose/arms/link_change.hpp"
#include "unit/arms/setup_samples.hpp"

namespace torquescope {
namespace setup_search_test {

using Eigen::Index;
using enum SetupKind;
using test::small_arm;
using test::small_arm_moved;

// as a set-up with this mistake shows them
ArmSamples mistaken(ArmSamples const& samples, SetupChange const& mistake) {
  return taken_as(samples, changed(setup_as_read(small_arm(true)), mistake));
}

class ArmSetupSearch : public testing::Test {
 protected:
  ArmSamples const sound = small_arm_moved();
};

TEST_F(ArmSetupSearch, SaysNothingOfASoundArm) {
  for (bool const with_masses : {true, false}) {
    SetupSearch const search = search_setup(sound, small_arm(with_masses));
    EXPECT_TRUE(search.steps.empty());
    EXPECT_LT(search.fit.error.maxCoeff(), 1e-3);
  }
}

TEST_F(ArmSetupSearch, SaysNothingWhereMassesOfTheFileAreOffByAThird) {
  SerialChain chain = small_arm(true);
  double factor = 0.7;
  for (auto& link : chain.links) {
    link = LinkInertia::from_vector(factor * link.vector());
    factor = 2.0 - factor;
  }
  EXPECT_TRUE(search_setup(sound, chain).steps.empty());
}

struct Mistake {
  char const* name;
  SetupChange mistake, found;
  bool with_masses = true;
};

class ArmSetupMistakes : public testing::TestWithParam<Mistake> {};

TEST_P(ArmSetupMistakes, AreFoundWithTheirNumber) {
  auto const& [name, mistake, expected, with_masses] = GetParam();
  SetupSearch const search = search_setup(mistaken(small_arm_moved(), mistake), small_arm(with_masses));
  ASSERT_EQ(search.steps.size(), 1u);
  SetupChange const& found = search.steps.front().change;
  EXPECT_EQ(found.kind, expected.kind);
  EXPECT_EQ(found.joint, expected.joint);
  EXPECT_EQ(found.other, expected.other);
  EXPECT_NEAR(found.number, expected.number, 0.01 * std::abs(expected.number));
  EXPECT_LT(search.fit.error.maxCoeff(), 0.01);
}

constexpr double quarter = 0.5 * std::numbers::pi, degree = std::numbers::pi / 180.0;

INSTANTIATE_TEST_SUITE_P(
    OfEveryKind, ArmSetupMistakes,
    testing::Values(Mistake{"joint_sign", {joint_sign, 1}, {joint_sign, 1}},
                    Mistake{"joint_sign_without_masses", {joint_sign, 1}, {joint_sign, 1}, false},
                    Mistake{"torque_sign", {torque_sign, 2}, {torque_sign, 2}, false},
                    Mistake{"joints_exchanged", {joints_exchanged, 0, 1}, {joints_exchanged, 0, 1}, false},
                    Mistake{"positions_exchanged", {positions_exchanged, 1, 2}, {positions_exchanged, 1, 2}},
                    Mistake{"torques_exchanged", {torques_exchanged, 2, 3}, {torques_exchanged, 2, 3}, false},
                    Mistake{"degrees", {position_factor, -1, -1, 1.0 / degree}, {position_factor, -1, -1, degree}},
                    Mistake{"zero", {zero, 1, -1, 0.3}, {zero, 1, -1, -0.3}},
                    Mistake{"quarter", {zero, 2, -1, quarter}, {zero, 2, -1, -quarter}, false},
                    Mistake{"one_unit", {torque_factor, 2, -1, 0.02}, {torque_factor, 2, -1, 50.0}},
                    Mistake{
                        "one_unit_without_masses", {torque_factor, 2, -1, 0.02}, {torque_factor, 2, -1, 50.0}, false}),
    [](auto const& of) { return of.param.name; });

TEST_F(ArmSetupSearch, FindsTheSideOfTheMotors) {
  SerialChain const chain = small_arm(true);
  ArmSamples samples = sound;
  for (Index j = 0; j < samples.tau.cols(); ++j)
    samples.tau.col(j) /= chain.joints[static_cast<std::size_t>(j)].gear_ratio;
  SetupSearch const search = search_setup(samples, chain);
  ASSERT_EQ(search.steps.size(), 1u);
  EXPECT_EQ(search.steps.front().change.kind, motor_side);
}

TEST_F(ArmSetupSearch, FindsTheDirectionOfGravity) {
  SerialChain chain = small_arm(true);
  chain.gravity = {9.81, 0.0, 0.0};  // the file says so, the arm stands on the floor
  SetupSearch const search = search_setup(sound, chain);
  ASSERT_EQ(search.steps.size(), 1u);
  EXPECT_EQ(search.steps.front().change.kind, gravity);
  EXPECT_LT((search.setup.chain.gravity - Eigen::Vector3d(0.0, 0.0, -9.81)).norm(), 1e-9);
}

TEST_F(ArmSetupSearch, FindsTheOtherConventionOfTheFile) {
  SerialChain wrong = small_arm(false);
  for (std::size_t j = wrong.joints.size(); j-- > 1;) {
    wrong.joints[j].a = wrong.joints[j - 1].a;
    wrong.joints[j].alpha = wrong.joints[j - 1].alpha;
  }
  SetupSearch const search = search_setup(sound, wrong, small_arm(false));
  ASSERT_EQ(search.steps.size(), 1u);
  EXPECT_EQ(search.steps.front().change.kind, dh_convention);
  EXPECT_TRUE(search.setup.is_of_other_convention);
}

TEST_F(ArmSetupSearch, FindsTwoMistakesTogether) {
  SerialChain const chain = small_arm(true);
  ArmSamples const samples = mistaken(mistaken(sound, {joint_sign, 1}), {torque_sign, 2});
  SetupSearch const search = search_setup(samples, chain);
  EXPECT_EQ(search.steps.size(), 2u);
  EXPECT_LT(search.fit.error.maxCoeff(), 0.01);
  EXPECT_LT(search.fit.file_error.maxCoeff(), 0.01);
}

TEST_F(ArmSetupSearch, GivesTheSameBitsInTwoThreads) {
  SerialChain const chain = small_arm(true);
  ArmSamples const samples = mistaken(sound, {zero, 1, -1, 0.3});
  auto const search = [&] { return search_setup(samples, chain); };
  auto one = std::async(std::launch::async, search), other = std::async(std::launch::async, search);
  SetupSearch const a = one.get(), b = other.get();
  ASSERT_EQ(a.steps.size(), b.steps.size());
  EXPECT_EQ(a.setup.zero, b.setup.zero);
  EXPECT_EQ(a.fit.error, b.fit.error);
}

TEST(SetupChangeOfAnArm, IsNoneWhereTheRecordingFitsItselfAsWell) {
  Eigen::VectorXd before(2), after(2), own(2);
  before << 0.4, 0.02;
  after << 0.15, 0.02;
  own << 0.38, 0.02;
  SetupNumbers const numbers;
  EXPECT_TRUE(halves_one(before, own, after, numbers.least_error, numbers));
  // seconds of a noisy recording: blocks between are predicted badly, whatever the set-up
  own[0] = 0.16;
  EXPECT_FALSE(halves_one(before, own, after, numbers.least_error, numbers));
  // another joint pays for it
  own[0] = 0.38;
  after[1] = 0.2;
  EXPECT_FALSE(halves_one(before, own, after, numbers.least_error, numbers));
}

TEST_F(ArmSetupSearch, NoLinkChangesWhereNoLoadIsPickedUp) {
  EXPECT_FALSE(find_link_change(sound, small_arm(false)).has_value());
}

TEST(ArmLinkChange, IsFoundToASample) {
  constexpr double at_s = 13.0;
  auto const change = find_link_change(small_arm_moved(0.5, at_s), small_arm(false));
  ASSERT_TRUE(change.has_value());
  EXPECT_NEAR(change->time_s, at_s, 0.1);
  EXPECT_EQ(change->recording, 0u);
}

}  // namespace setup_search_test
}  // namespace torquescope
