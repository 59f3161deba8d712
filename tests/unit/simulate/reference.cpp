#include "engine/simulate/reference.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <vector>

using namespace torquescope;

namespace reference_test {

RandomKey key_of(std::uint64_t seed, std::uint32_t run = 0) { return {seed, run, RandomDomain::simulation}; }

struct Peaks {
  double position = 0.0, speed_forward = 0.0, speed_backward = 0.0, acceleration = 0.0;
};

Peaks peaks(Reference const& reference, double duration_s) {
  Peaks found;
  for (int i = 0; i <= 20000; ++i) {
    auto const point = reference.at(duration_s * i / 20000);
    found.position = std::max(found.position, std::abs(point.q));
    found.speed_forward = std::max(found.speed_forward, point.dq);
    found.speed_backward = std::max(found.speed_backward, -point.dq);
    found.acceleration = std::max(found.acceleration, std::abs(point.ddq));
  }
  return found;
}

ReferenceOptions of_kind(std::string const& kind) {
  ReferenceOptions options;
  options.kind = kind;
  options.amplitude = 1.2;
  return options;
}

constexpr double duration_s = 40.0;

class EveryReference : public testing::TestWithParam<std::string> {};

TEST_P(EveryReference, StartsFromRestAtTheCentre) {
  auto options = of_kind(GetParam());
  options.centre = 0.3;
  auto const point = make_reference(options, duration_s, key_of(1))->at(0.0);
  EXPECT_EQ(point.q, 0.3);
  EXPECT_EQ(point.dq, 0.0);
  if (GetParam() != "trapezoid") {
    EXPECT_EQ(point.ddq, 0.0);
  }
}

TEST_P(EveryReference, AtManyTimesHasTheBitsOfEach) {
  auto const reference = make_reference(of_kind(GetParam()), duration_s, key_of(5));
  std::vector<double> times_s;
  for (int i = 0; i < 1037; ++i) times_s.push_back(0.0137 * i);
  std::vector<double> q(times_s.size()), dq(times_s.size()), ddq(times_s.size());
  reference->at_each(times_s, {q, dq, ddq});
  for (std::size_t i = 0; i < times_s.size(); ++i) {
    auto const point = reference->at(times_s[i]);
    ASSERT_EQ(q[i], point.q) << i;
    ASSERT_EQ(dq[i], point.dq) << i;
    ASSERT_EQ(ddq[i], point.ddq) << i;
  }
}

TEST_P(EveryReference, VelocityAndAccelerationAreDerivatives) {
  auto const reference = make_reference(of_kind(GetParam()), duration_s, key_of(2));
  constexpr double h = 1e-5;
  int off = 0;
  for (int i = 1; i < 4000; ++i) {
    // between the knots: the ramp ends with a jump of jerk
    double const t = duration_s * (i + 0.37) / 4000.0;
    auto const before = reference->at(t - h), here = reference->at(t), after = reference->at(t + h);
    EXPECT_NEAR((after.q - before.q) / (2.0 * h), here.dq, 1e-4);
    // the trapezoid's acceleration jumps; a difference across a jump proves nothing
    if (std::abs((after.dq - before.dq) / (2.0 * h) - here.ddq) > 1e-6) ++off;
  }
  EXPECT_LE(off, GetParam() == "trapezoid" ? 2 : 0);
}

TEST_P(EveryReference, StaysWithinItsLimitsAndMovesBothWays) {
  auto options = of_kind(GetParam());
  auto const found = peaks(*make_reference(options, duration_s, key_of(3)), duration_s);
  EXPECT_LE(found.position, options.amplitude * (1.0 + 1e-12));
  EXPECT_LE(std::max(found.speed_forward, found.speed_backward), options.max_speed * (1.0 + 1e-12));
  EXPECT_LE(found.acceleration, options.max_acceleration * (1.0 + 1e-12));
  // one of the limits is used, and both directions
  double const use =
      std::max({found.position / options.amplitude, found.speed_forward / options.max_speed,
                found.speed_backward / options.max_speed, found.acceleration / options.max_acceleration});
  EXPECT_GT(use, 0.99);
  EXPECT_GT(found.speed_forward, 0.5 * found.speed_backward);
  EXPECT_GT(found.speed_backward, 0.5 * found.speed_forward);
}

TEST_P(EveryReference, GivesTheSameBitsForTheSameKey) {
  auto const options = of_kind(GetParam());
  auto const one = make_reference(options, duration_s, key_of(9));
  auto const two = make_reference(options, duration_s, key_of(9));
  for (int i = 0; i < 500; ++i) EXPECT_EQ(one->at(0.0731 * i).q, two->at(0.0731 * i).q);
}

INSTANTIATE_TEST_SUITE_P(AllKinds, EveryReference, testing::ValuesIn(reference_kinds()),
                         [](auto const& tested) { return tested.param; });

TEST(Multisine, RepeatsAfterOneOverItsBaseFrequency) {
  ReferenceOptions options;
  options.base_hz = 0.25;
  options.harmonics = {1, 3, 4, 9};
  auto const reference = make_reference(options, 12.0, key_of(4));
  for (double t = options.ramp_s; t < 4.0; t += 0.013) {
    EXPECT_NEAR(reference->at(t).q, reference->at(t + 4.0).q, 1e-13);
    EXPECT_NEAR(reference->at(t).dq, reference->at(t + 8.0).dq, 1e-12);
  }
}

TEST(Multisine, DiffersBySeedAndByRecording) {
  ReferenceOptions const options;
  double const here = make_reference(options, 10.0, key_of(5))->at(3.3).q;
  EXPECT_NE(here, make_reference(options, 10.0, key_of(6))->at(3.3).q);
  EXPECT_NE(here, make_reference(options, 10.0, key_of(5, 1))->at(3.3).q);
}

TEST(Multisine, TakesItsFrequenciesFromBandHarmonicsOrList) {
  ReferenceOptions options;
  EXPECT_EQ(reference_frequencies_hz(options).size(), 10u);  // 0.1 to 1.0 Hz in steps of 0.1, both ends
  options.harmonics = {1, 5};
  EXPECT_EQ(reference_frequencies_hz(options), (std::vector<double>{0.1, 0.5}));
  options.frequencies_hz = {0.37};
  EXPECT_EQ(reference_frequencies_hz(options), (std::vector<double>{0.37}));
}

TEST(Trapezoid, CruisesAtEverySpeedInBothDirections) {
  auto options = of_kind("trapezoid");
  options.speeds = {0.2, 0.5, 2.0};
  auto const reference = make_reference(options, 60.0, key_of(7));
  std::set<double> cruising;
  for (double t = 0.0; t < 60.0; t += 0.01) {
    auto const point = reference->at(t);
    if (point.ddq == 0.0 && point.dq != 0.0) cruising.insert(point.dq);
  }
  EXPECT_EQ(cruising, (std::set<double>{-2.0, -0.5, -0.2, 0.2, 0.5, 2.0}));
}

TEST(Chirp, SweepsItsBand) {
  auto options = of_kind("chirp");
  options.band_hz = {0.5, 4.0};
  options.ramp_s = 0.0;
  auto const reference = make_reference(options, 20.0, key_of(8));
  // crossings of the centre per second: twice the frequency
  auto const crossings = [&](double from, double to) {
    int count = 0;
    for (double t = from; t < to; t += 1e-3) count += reference->at(t).q * reference->at(t + 1e-3).q < 0.0;
    return count / (to - from);
  };
  EXPECT_NEAR(crossings(0.0, 2.0), 2.0 * 0.675, 0.6);
  EXPECT_NEAR(crossings(18.0, 20.0), 2.0 * 3.825, 0.6);
}

TEST(ReferenceCheck, RefusesWhatCannotBeRecorded) {
  Section const section{"simulate.reference", {}, {}};
  auto const count = [&](ReferenceOptions const& options) {
    std::vector<Problem> problems;
    check_reference(options, 10.0, 200.0, section, problems);
    for (auto const& problem : problems) EXPECT_FALSE(problem.help.empty());
    return problems.size();
  };
  EXPECT_EQ(count({}), 0u);

  ReferenceOptions options;
  options.frequencies_hz = {120.0};
  EXPECT_EQ(count(options), 1u);  // above half the rate
  options = {};
  options.band_hz = {1.0, 0.1};
  EXPECT_EQ(count(options), 1u);
  options = {};
  options.band_hz = {0.11, 0.19};
  EXPECT_EQ(count(options), 1u);  // no multiple of 0.1 inside
  options = {};
  options.harmonics = {1.5};
  EXPECT_EQ(count(options), 1u);
  options = {};
  options.ramp_s = 10.0;
  EXPECT_EQ(count(options), 1u);
  options = of_kind("trapezoid");
  EXPECT_EQ(count(options), 1u);  // the slowest strokes take longer than 10 s
  options.speeds = {1.0, 5.0};
  EXPECT_EQ(count(options), 1u);  // above max_speed
  options.speeds = {};
  EXPECT_EQ(count(options), 1u);
}

}  // namespace reference_test
