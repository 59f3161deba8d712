// A motion that cannot tell some effects is searched for the others: the torque of a motor that turns one way, a spring
// from strokes at one speed. And what a simulator explains leaves validation recordings as it leaves the training one.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "engine/base/random_stream.hpp"
#include "engine/diagnose/joint_diagnosis.hpp"
#include "unit/pipeline/clean_records.hpp"

using namespace torquescope;
using namespace torquescope::test;

namespace closed_effects_test {

using ::testing::HasSubstr;

// torque of a joint with these parameters on a motion, with noise
template <class Position, class Torque>
Recording recording_of(Position const& position, Torque const& torque, double seconds, std::uint32_t index) {
  constexpr double rate_hz = 500.0, noise = 0.005;
  Recording recording;
  recording.name = "motion";
  recording.rate_hz = rate_hz;
  auto const n = static_cast<Eigen::Index>(seconds * rate_hz);
  recording.time_s.setLinSpaced(n, 0.0, static_cast<double>(n - 1) / rate_hz);
  recording.position = recording.torque = recording.time_s;
  RandomStream random({79, index, RandomDomain::test}, 0, 0);
  for (Eigen::Index k = 0; k < n; ++k) {
    double const t = recording.time_s[k], h = 1e-4;
    double const q = position(t), dq = (position(t + h) - position(t - h)) / (2.0 * h),
                 ddq = (position(t + h) - 2.0 * q + position(t - h)) / (h * h);
    recording.position[k] = q;
    recording.torque[k] = 0.02 * ddq + 0.1 * dq + 0.4 * std::tanh(dq / 1e-3) + torque(q) + noise * random.normal();
  }
  return recording;
}

Diagnosis diagnosed(Recording const& train, std::vector<Recording> const& validate,
                    std::vector<std::string> const& candidates) {
  static FilterOptions const filter = [] {
    FilterOptions options;
    options.cutoff_hz = 40.0;
    options.parallel_cutoff_hz = 15.0;
    options.decimate_to_hz = 100.0;
    return options;
  }();
  static Section const section{};
  DiagnosisInput input{train, validate, clean_regressor(), filter, section};
  for (auto const& name : candidates) input.candidates.push_back(find_effect(name));
  input.seed = 1;
  input.threads = 2;
  return diagnose_joint(input, {});
}

bool names(Diagnosis const& diagnosis, std::string const& name) {
  auto const& effects = diagnosis.joints.front().effects;
  return std::any_of(effects.begin(), effects.end(), [&](NamedEffect const& one) { return one.name == name; });
}

TEST(ClosedEffects, CoggingIsFoundInOneDirection) {
  Recording const recording =
      recording_of([](double t) { return 2.0 * t + 0.2 * std::sin(3.0 * t) + 0.1 * std::sin(7.1 * t); },
                   [](double q) { return 0.3 * std::cos(7.0 * q); }, 20.0, 1);
  Diagnosis const diagnosis = diagnosed(recording, {}, {"cogging", "presliding", "spring", "contact"});
  EXPECT_TRUE(names(diagnosis, "cogging")) << word(diagnosis.verdict) << ": " << diagnosis.reason;
  EXPECT_THAT(diagnosis.reason, HasSubstr("Only one direction of motion was recorded"));
  for (auto const& parameter : diagnosis.joints.front().baseline) EXPECT_NE(parameter.name, "offset");
}

// there and back, turning round within a twentieth of a stroke
double strokes(double t) {
  constexpr double stroke_s = 5.0;
  double const phase = std::fmod(t, 2.0 * stroke_s) / stroke_s;  // 0 .. 2
  double const triangle = phase < 1.0 ? phase : 2.0 - phase;
  constexpr double edge = 0.025;
  double const from_end = std::min(triangle, 1.0 - triangle);
  double const rounded = from_end < edge ? 0.5 * (edge - from_end) * (edge - from_end) / edge : 0.0;
  return 2.0 * (triangle < 0.5 ? triangle + rounded : triangle - rounded);
}

TEST(ClosedEffects, ASpringIsFoundAtOneSpeed) {
  Recording const recording = recording_of(
      strokes, [](double q) { return 0.8 * (q - 1.0); }, 40.0, 2);
  Diagnosis const diagnosis = diagnosed(recording, {}, {"spring", "stribeck", "speed_drag"});
  EXPECT_TRUE(names(diagnosis, "spring")) << word(diagnosis.verdict) << ": " << diagnosis.reason;
  EXPECT_THAT(diagnosis.reason, HasSubstr("Only one speed was recorded: nothing is known of effects of the velocity"));
  for (auto const& candidate : diagnosis.joints.front().candidates) EXPECT_EQ(candidate.name, "spring");
}

TEST(ClosedEffects, WhereNothingIsFoundOneDirectionIsToBlame) {
  Recording const recording =
      recording_of([](double t) { return 2.0 * t + 0.2 * std::sin(3.0 * t); }, [](double) { return 0.0; }, 20.0, 3);
  Diagnosis const diagnosis = diagnosed(recording, {}, {"cogging", "spring"});
  EXPECT_EQ(diagnosis.verdict, Verdict::insufficient) << diagnosis.reason;
  EXPECT_THAT(diagnosis.reason, HasSubstr("both directions"));
}

TEST(ValidationSimulator, ACopyOfTheTrainingRecordingHasTheTrainingError) {
  auto const joint = clean_joint();
  Recording recording = recorded(simulate_joint(joint.plan, 31));
  FilterOptions options;
  options.cutoff_hz = 50.0;
  Motion const motion = differentiate(recording, options, {});
  Eigen::VectorXd const others = (1.5 * (1.7 * recording.time_s.array()).sin()).matrix();
  recording.torque += others;
  recording.simulated_torque = clean_regressor().columns(motion) * joint.truth + others;
  Diagnosis const diagnosis = diagnosed(recording, {recording}, {"stribeck"});
  JointDiagnosis const& found = diagnosis.joints.front();
  ASSERT_GT(found.train_relerr, 0.0);
  EXPECT_NEAR(found.validation_relerr / found.train_relerr, 1.0, 0.2) << diagnosis.reason;
}

}  // namespace closed_effects_test
