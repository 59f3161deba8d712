// Which payload is carried when, as a job says it, and what is refused.

#include "engine/experiment/arm_payloads.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "engine/experiment/job_sections.hpp"

namespace torquescope {
namespace arm_payloads_test {

RecordingOptions three_recordings() {
  RecordingOptions options;
  options.train = {"a.csv", "b.csv", "c.csv"};
  options.validate = {"d.csv"};
  return options;
}

std::vector<std::string> problems_of(RecordingOptions const& options, bool has_gains) {
  std::vector<Problem> problems;
  plan_payloads({}, options, has_gains, problems);
  std::vector<std::string> said;
  for (auto const& problem : problems) said.push_back(problem.what);
  return said;
}

TEST(ArmPayloads, OfOneMassAreOnePayload) {
  auto options = three_recordings();
  options.payload_kg = {0.0, 2.5, 2.5};
  options.validate_payload_kg = {2.5};
  std::vector<Problem> problems;
  auto const plan = plan_payloads({}, options, true, problems);
  EXPECT_TRUE(problems.empty());
  ASSERT_EQ(plan.payloads.size(), 1u);
  EXPECT_FALSE(plan.payloads[0].first_moments.has_value());
  EXPECT_EQ(plan.train, (CarriedPayloads{std::nullopt, 0, 0}));
  EXPECT_EQ(plan.validate, CarriedPayloads{0});
}

TEST(ArmPayloads, OfOtherFirstMomentsAreOthers) {
  auto options = three_recordings();
  options.payload_kg = {0.0, 2.5, 2.5};
  options.payload_first_moments_kgm = {0, 0, 0, 0.1, 0, 0.2, 0, 0.1, 0.2};
  std::vector<Problem> problems;
  auto const plan = plan_payloads({}, options, true, problems);
  ASSERT_EQ(plan.payloads.size(), 2u);
  EXPECT_EQ(plan.payloads[1].first_moments, Eigen::Vector3d(0, 0.1, 0.2));
}

TEST(ArmPayloads, WithoutAnyNothingIsCarried) {
  std::vector<Problem> problems;
  auto const plan = plan_payloads({}, three_recordings(), false, problems);
  EXPECT_TRUE(problems.empty());
  EXPECT_TRUE(plan.payloads.empty());
  EXPECT_EQ(plan.train, CarriedPayloads(3));
}

TEST(ArmPayloads, OfUnknownMassAreOnePayload) {
  auto options = three_recordings();
  std::vector<Problem> problems;
  Job const job = parse_job("[recording]\npayload_kg = [0, \"unknown\", \"unknown\"]\n", "arm.toml");
  options.payload_kg = read_options<RecordingOptions>(job, problems).payload_kg;
  ASSERT_EQ(options.payload_kg.size(), 3u);
  options.validate_payload_kg = {options.payload_kg[1]};
  auto const plan = plan_payloads({}, options, false, problems);
  EXPECT_TRUE(problems.empty());
  ASSERT_EQ(plan.payloads.size(), 1u);
  EXPECT_FALSE(plan.payloads[0].mass_kg.has_value());
  EXPECT_EQ(plan.train, (CarriedPayloads{std::nullopt, 0, 0}));
  EXPECT_EQ(plan.validate, CarriedPayloads{0});
  options.payload_kg[0] = options.payload_kg[1];
  EXPECT_THAT(problems_of(options, false), testing::ElementsAre(testing::HasSubstr("in every training recording")));
  options.payload_kg[0] = 1.0;
  options.payload_first_moments_kgm = {0.1, 0.0, 0.0, 0.0, 0.2, 0.0, 0.0, 0.0, 0.0};
  EXPECT_THAT(problems_of(options, false), testing::ElementsAre(testing::HasSubstr("carries an unknown mass")));
}

TEST(ArmPayloads, AreRefusedWhereTheyCannotBe) {
  auto options = three_recordings();
  EXPECT_THAT(problems_of(options, true), testing::ElementsAre(testing::HasSubstr("different payloads")));
  options.payload_kg = {0.0, 2.5};
  EXPECT_THAT(problems_of(options, false), testing::ElementsAre("payload_kg has 2 numbers, for 3 recordings"));
  options.payload_kg = {0.0, -2.5, 1.0};
  EXPECT_THAT(problems_of(options, false), testing::ElementsAre(testing::HasSubstr("below 0")));
  options.payload_kg = {2.5, 2.5, 2.5};
  EXPECT_THAT(problems_of(options, true), testing::ElementsAre(testing::HasSubstr("different payloads")));
  options.payload_kg = {0.0, 2.5, 2.5};
  options.validate_payload_kg = {3.0};
  EXPECT_THAT(problems_of(options, true), testing::ElementsAre("no training recording carries 3 kg"));
}

}  // namespace arm_payloads_test
}  // namespace torquescope
