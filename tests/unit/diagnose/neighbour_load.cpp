// A joint that another joint of its arm loads: the two-link arm by hand (inertia, centrifugal force and gravity of a
// second link), and a second joint that moves and loads nothing.

#include "engine/diagnose/neighbour_load.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "engine/base/random_stream.hpp"
#include "engine/diagnose/joint_diagnosis.hpp"
#include "unit/pipeline/clean_records.hpp"

using namespace torquescope;
using namespace torquescope::test;

namespace neighbour_load_test {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

struct Instant {
  double q, dq, ddq;
};

// sums of two sines
Instant moving(double t, double slow, double fast) {
  return {0.8 * std::sin(slow * t) + 0.3 * std::sin(fast * t),
          0.8 * slow * std::cos(slow * t) + 0.3 * fast * std::cos(fast * t),
          -0.8 * slow * slow * std::sin(slow * t) - 0.3 * fast * fast * std::sin(fast * t)};
}

// what the second link does to the first joint, and a spring that has nothing to do with it
struct Missing {
  double coupling = 0.0, spring = 0.0;
};

Recording recorded(Missing const& missing) {
  constexpr double rate_hz = 500.0, noise = 0.02;
  constexpr Eigen::Index n = 10000;
  Recording recording;
  recording.name = "arm";
  recording.rate_hz = rate_hz;
  recording.time_s.setLinSpaced(n, 0.0, static_cast<double>(n - 1) / rate_hz);
  recording.position = recording.torque = recording.time_s;
  recording.other_positions.resize(n, 2);
  recording.other_columns = {"q2", "q3"};
  RandomStream random({83, 1, RandomDomain::test}, 0, 0);
  for (Eigen::Index k = 0; k < n; ++k) {
    double const t = recording.time_s[k];
    auto const a = moving(t, 1.1, 2.7), b = moving(t, 0.9, 3.3), c = moving(t, 1.3, 2.2);
    double const coupling = 0.05 * std::cos(b.q) * (2.0 * a.ddq + b.ddq) -
                            0.05 * std::sin(b.q) * (2.0 * a.dq * b.dq + b.dq * b.dq) + 0.6 * std::cos(a.q + b.q);
    recording.position[k] = a.q;
    recording.other_positions(k, 0) = b.q;
    recording.other_positions(k, 1) = c.q;
    recording.torque[k] = 0.02 * a.ddq + 0.1 * a.dq + 0.4 * std::tanh(a.dq / 1e-3) + missing.coupling * coupling +
                          missing.spring * a.q + noise * random.normal();
  }
  return recording;
}

FilterOptions filter() {
  FilterOptions options;
  options.cutoff_hz = 40.0;
  options.parallel_cutoff_hz = 15.0;
  options.decimate_to_hz = 100.0;
  return options;
}

NeighbourLoad load_of(Recording const& recording) {
  RecordPipeline const pipeline(JointModel(clean_regressor()), filter(), recording.rate_hz, recording.position.size());
  return neighbour_load(recording, pipeline, pipeline.process(recording)).value();
}

TEST(NeighbourLoad, IsOfTheJointThatLoads) {
  NeighbourLoad const load = load_of(recorded({.coupling = 1.0}));
  EXPECT_EQ(load.gain.change, HeldOutChange::lower);
  EXPECT_THAT(load.columns, ElementsAre("q2"));
  EXPECT_LT(load.gain.after, 0.3 * load.gain.before);
}

TEST(NeighbourLoad, IsNoneOfJointsThatOnlyMove) {
  EXPECT_NE(load_of(recorded({})).gain.change, HeldOutChange::lower);
  EXPECT_NE(load_of(recorded({.spring = 0.5})).gain.change, HeldOutChange::lower);
}

TEST(NeighbourLoad, IsNotAskedForWhereNoOtherJointMoves) {
  Recording alone = recorded({.coupling = 1.0});
  alone.other_positions.resize(alone.position.size(), 0);
  RecordPipeline const pipeline(JointModel(clean_regressor()), filter(), alone.rate_hz, alone.position.size());
  EXPECT_FALSE(neighbour_load(alone, pipeline, pipeline.process(alone)).has_value());
}

Diagnosis diagnosed(Recording const& train) {
  FilterOptions const options = filter();
  Section const section{};
  DiagnosisInput input{train, {}, clean_regressor(), options, section};
  for (char const* name : {"spring", "cogging", "load_dependent_friction"})
    input.candidates.push_back(find_effect(name));
  input.seed = 1;
  input.threads = 2;
  return diagnose_joint(input, {});
}

TEST(DiagnosisOfOneJoint, GivesNoNameToTheLoadOfAnother) {
  Diagnosis const diagnosis = diagnosed(recorded({.coupling = 1.0}));
  EXPECT_EQ(diagnosis.verdict, Verdict::unexplained) << diagnosis.reason;
  EXPECT_TRUE(diagnosis.joints.front().effects.empty());
  EXPECT_THAT(diagnosis.reason, HasSubstr("goes with the motion of q2"));
  EXPECT_THAT(diagnosis.reason, HasSubstr("Diagnose the arm as a whole"));
}

TEST(DiagnosisOfOneJoint, KeepsItsNameBesideJointsThatOnlyMove) {
  Diagnosis const diagnosis = diagnosed(recorded({.spring = 0.5}));
  EXPECT_TRUE(names_physics(diagnosis.verdict)) << diagnosis.reason;
  ASSERT_FALSE(diagnosis.joints.front().effects.empty());
  EXPECT_EQ(diagnosis.joints.front().effects.front().name, "spring");
}

}  // namespace neighbour_load_test
