// An arm decided on all samples: a complete one lacks nothing, an effect is named at its joint alone, on any number of
// threads.

#include "engine/diagnose/arm_diagnosis.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>

#include "unit/diagnose/planar_arm.hpp"

using namespace torquescope;
using namespace torquescope::test;

namespace arm_diagnosis_test {

FilterOptions ten_hertz() {
  FilterOptions filter;
  filter.cutoff_hz = 10.0;
  filter.parallel_cutoff_hz = 5.0;
  filter.decimate_to_hz = 25.0;
  return filter;
}

Diagnosis diagnosed(PlanarArm arm, int threads = 1) {
  ArmTerms terms;
  terms.friction = {"viscous", "coulomb", "offset"};
  terms.drives = DriveInertias::left_out;
  Section const section{};
  ArmModel const model(planar_chain(), terms, section);
  std::vector<RecordedArm> const train{recorded(arm)};
  arm.pace = 0.87;
  arm.seed += 100;
  std::vector<RecordedArm> const validation{recorded(arm)};
  std::vector<Effect const*> effects;
  for (auto const* name : {"load_dependent_friction", "cogging", "stribeck", "spring", "asymmetric_viscous"})
    effects.push_back(find_effect(name));
  std::vector<std::vector<Effect const*>> const candidates(2, effects);
  FilterOptions const filter = ten_hertz();
  ArmDiagnosisInput input{model, train, validation, candidates, filter, section};
  input.seed = 3;
  input.threads = threads;
  return diagnose_arm(input, {});
}

bool is_among(std::string const& name, NamedEffect const& effect) {
  auto const& alike = effect.equivalent;
  return effect.name == name || std::find(alike.begin(), alike.end(), name) != alike.end();
}

// of joint 2
void expect_named(std::string const& name, Diagnosis const& diagnosis) {
  ASSERT_EQ(diagnosis.joints.size(), 2U);
  JointDiagnosis const &first = diagnosis.joints[0], &second = diagnosis.joints[1];
  EXPECT_EQ(first.verdict, Verdict::none) << first.reason;
  EXPECT_TRUE(first.effects.empty());
  ASSERT_EQ(second.effects.size(), 1U) << second.reason;
  EXPECT_TRUE(is_among(name, second.effects.front())) << second.effects.front().name;
  EXPECT_LT(second.augmented_validation_relerr, 0.8 * second.validation_relerr);
  EXPECT_LT(second.augmented_cv_relerr, 0.8 * second.cv_relerr);
}

TEST(ArmDiagnosis, ACompleteArmLacksNothing) {
  for (std::uint64_t const seed : {1U, 2U, 3U, 4U}) {
    PlanarArm arm;
    arm.seed = seed;
    Diagnosis const diagnosis = diagnosed(arm);
    EXPECT_EQ(diagnosis.verdict, Verdict::none) << diagnosis.reason;
    for (auto const& joint : diagnosis.joints) {
      EXPECT_EQ(joint.verdict, Verdict::none) << joint.reason;
      EXPECT_TRUE(joint.decision.has_value());
      EXPECT_LT(joint.validation_relerr, 0.01);
    }
  }
}

TEST(ArmDiagnosis, FrictionThatGrowsWithTheLoadOfTheLinksIsNamedWhereItIs) {
  PlanarArm arm;
  arm.effect = [](double, double dq, double load) { return 0.05 * std::abs(load) * std::copysign(1.0, dq); };
  Diagnosis const one = diagnosed(arm), two = diagnosed(arm, 2);
  expect_named("load_dependent_friction", one);
  ASSERT_FALSE(one.joints[1].effects.empty());
  EXPECT_NEAR(one.joints[1].effects.front().parameters.front().value, 0.05, 0.01);
  for (std::size_t j = 0; j < 2; ++j) {
    auto const &a = one.joints[j], &b = two.joints[j];
    double const left[4] = {a.train_relerr, a.validation_relerr, a.cv_relerr, a.decision->steps[0].effects[0].gain};
    double const right[4] = {b.train_relerr, b.validation_relerr, b.cv_relerr, b.decision->steps[0].effects[0].gain};
    EXPECT_EQ(std::memcmp(left, right, sizeof(left)), 0);
  }
}

TEST(ArmDiagnosis, CoggingIsNamedWhereItIs) {
  PlanarArm arm;
  arm.effect = [](double q, double, double) { return 0.25 * std::sin(9.0 * q); };
  expect_named("cogging", diagnosed(arm));
}

TEST(ArmDiagnosis, AStribeckCurveIsNamedWhereItIs) {
  PlanarArm arm;
  arm.effect = [](double, double dq, double) { return std::copysign(1.0 * std::exp(-std::pow(dq / 0.3, 2)), dq); };
  expect_named("stribeck", diagnosed(arm));
}

}  // namespace arm_diagnosis_test
