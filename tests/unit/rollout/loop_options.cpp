// [loop]: what does not go together is refused where it stands, with help; the rest becomes the setting of a loop.

#include "engine/simulate/rollout/loop_options.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

using namespace torquescope;
using testing::ElementsAre;
using testing::HasSubstr;

namespace loop_options_test {

struct Reading {
  LoopOptions options;
  std::vector<Problem> problems;
};

// every value at a line of its own
Reading read(std::vector<std::pair<std::string, OptionValue>> const& settings) {
  Section section{"loop", {"job.toml", 1, 1, 1, ""}, {}};
  int line = 1;
  for (auto const& [key, value] : settings) {
    ++line;
    section.settings.push_back({key, value, {"job.toml", line, 1, 1, ""}, {"job.toml", line, 10, 1, ""}});
  }
  Reading reading;
  LoopOptions::table().apply(section, reading.options, reading.problems);
  if (reading.problems.empty()) check_loop(reading.options, section, reading.problems);
  return reading;
}

std::string text(char const* word) { return word; }
std::vector<std::string> texts(std::initializer_list<std::string> words) { return words; }

TEST(LoopOptions, AnIdentifiedLoopNeedsNothing) {
  auto const [options, problems] = read({});
  EXPECT_TRUE(problems.empty());
  EXPECT_EQ(form_of(options), LoopForm::identified);
  EXPECT_TRUE(missing_gains(options).empty());
  EXPECT_EQ(channels_of(options), (CountedChannels{true, true}));
}

TEST(LoopOptions, RefuseWordsNobodyKnowsAtTheirPlace) {
  struct {
    std::string key;
    OptionValue value;
    std::string says;
  } const cases[] = {{"controller", text("pdd"), "pdd"},
                     {"reference", text("smooth"), "smooth"},
                     {"speed", text("filtered"), "filtered"},
                     {"kpp", 3.0, "kpp"},
                     {"kp", -1.0, "kp"},
                     {"speed_samples", std::int64_t{17}, "speed_samples"},
                     {"command_delay_s", 0.3, "command_delay_s"},
                     {"channels", texts({"position", "speed"}), "speed"},
                     {"channels", texts({}), "channels"},
                     {"fit", texts({"kq"}), "kq"}};
  for (auto const& [key, value, says] : cases) {
    auto const problems = read({{"rate_hz", 500.0}, {key, value}}).problems;
    ASSERT_EQ(problems.size(), 1u) << key;
    EXPECT_EQ(problems[0].code, ExitCode::bad_job) << key;
    EXPECT_EQ(problems[0].place.line, 3) << key;
    EXPECT_THAT(problems[0].what, HasSubstr(says)) << key;
    EXPECT_FALSE(problems[0].help.empty()) << key;
  }
}

TEST(LoopOptions, RefuseGainsOfAnotherController) {
  struct {
    char const* controller;
    char const* gain;
    bool belongs;
  } const cases[] = {
      {"p", "kp", true},    {"p", "kd", false},         {"p", "ki", false},          {"pi", "ki", true},
      {"pi", "kv", false},  {"pd", "kd", true},         {"pd", "ki", false},         {"pid", "ki", true},
      {"pid", "kv", false}, {"p_velocity", "kv", true}, {"p_velocity", "kd", false}, {"p_velocity", "ki", false},
      {"p_pi", "ki", true}, {"p_pi", "kd", false},      {"identified", "kp", false}, {"none", "kv", false}};
  for (auto const& [controller, gain, belongs] : cases) {
    auto const problems = read({{"controller", text(controller)}, {gain, 2.0}}).problems;
    ASSERT_EQ(problems.size(), belongs ? 0u : 1u) << controller << " " << gain;
    if (belongs) continue;
    EXPECT_EQ(problems[0].code, ExitCode::bad_job);
    EXPECT_EQ(problems[0].place.line, 3);
    EXPECT_THAT(problems[0].what, HasSubstr(gain));
    EXPECT_THAT(problems[0].what, HasSubstr(controller));
    EXPECT_FALSE(problems[0].help.empty());
  }
}

TEST(LoopOptions, FitBeginsSomewhere) {
  // a limit that is not there has no value to begin at
  auto const without = read({{"controller", text("p")}, {"fit", texts({"torque_limit"})}}).problems;
  ASSERT_EQ(without.size(), 1u);
  EXPECT_THAT(without[0].help, HasSubstr("torque_limit"));
  EXPECT_TRUE(
      read({{"controller", text("p")}, {"torque_limit", 3.0}, {"fit", texts({"torque_limit"})}}).problems.empty());
  EXPECT_TRUE(read({{"controller", text("p")}, {"fit", texts({"torque_delay_s"})}}).problems.empty());
  // an identified controller has its delay in itself
  auto const identified = read({{"fit", texts({"command_delay_s"})}}).problems;
  ASSERT_EQ(identified.size(), 1u);
  EXPECT_THAT(identified[0].help, HasSubstr("p_velocity"));
}

// as gains are refused that are written, so are those that a fit is asked for
TEST(LoopOptions, FitOfAGainOfAnotherControllerIsRefused) {
  auto const problems = read({{"controller", text("pd")}, {"fit", texts({"kv"})}}).problems;
  ASSERT_EQ(problems.size(), 1u);
  EXPECT_EQ(problems[0].place.line, 3);
  EXPECT_THAT(problems[0].what, HasSubstr("kv"));
  EXPECT_FALSE(problems[0].help.empty());
}

TEST(LoopOptions, BecomeTheSettingOfALoop) {
  auto const [options, problems] = read({{"controller", text("p_pi")},
                                         {"rate_hz", 250.0},
                                         {"kp", 12.0},
                                         {"torque_limit", 3.0},
                                         {"speed_samples", std::int64_t{3}},
                                         {"fit", texts({"kp", "torque_delay_s", "kv"})},
                                         {"channels", texts({"torque"})},
                                         {"reference", text("straight")}});
  EXPECT_TRUE(problems.empty());
  LoopSetting const setting = loop_setting(options, 1000.0);
  EXPECT_EQ(setting.form, LoopForm::p_pi);
  EXPECT_EQ(setting.values[LoopKey::kp], 12.0);
  EXPECT_EQ(setting.values[LoopKey::torque_limit], 3.0);
  EXPECT_EQ(setting.values[LoopKey::added_command_gain], 1.0) << "not given";
  EXPECT_TRUE(std::isinf(setting.values[LoopKey::goal_speed_limit])) << "not given";
  // gains that are left out first, each once
  EXPECT_THAT(setting.free, ElementsAre(LoopKey::kv, LoopKey::ki, LoopKey::kp, LoopKey::torque_delay_s));
  EXPECT_EQ(setting.hold_ticks, 4u);
  EXPECT_EQ(setting.speed_samples, 3u);
  EXPECT_EQ(channels_of(options), (CountedChannels{false, true}));
  EXPECT_TRUE(track_options(options).straight_reference);
  EXPECT_EQ(loop_setting(options, 100.0).hold_ticks, 1u) << "several ticks a sample";
}

TEST(LoopOptions, EveryKeyOfALoopIsAnOption) {
  auto const described = LoopOptions::table().describe();
  for (std::size_t k = 0; k < loop_keys; ++k) {
    auto const& facts = facts_of(static_cast<LoopKey>(k));
    EXPECT_EQ(facts.key, static_cast<LoopKey>(k));
    EXPECT_EQ(loop_key_of(facts.name), facts.key);
    EXPECT_TRUE(std::any_of(described.begin(), described.end(), [&](auto const& one) { return one.key == facts.name; }))
        << facts.name;
    // and lands in its own place
    double const value = k == 4 ? 0.5 : 0.125;
    LoopOptions options;
    std::vector<Problem> problems;
    LoopOptions::table().apply({"loop", {}, {{facts.name, value}}}, options, problems);
    EXPECT_TRUE(problems.empty()) << facts.name;
    EXPECT_EQ(loop_setting(options, 500.0).values[facts.key], value) << facts.name;
  }
  for (auto const& word_of_form : loop_form_words()) EXPECT_EQ(word(*loop_form_of(word_of_form)), word_of_form);
}

}  // namespace loop_options_test
