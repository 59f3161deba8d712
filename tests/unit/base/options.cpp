#include "engine/base/options.hpp"

#include <gtest/gtest.h>

namespace torquescope {
namespace options_test {

struct Lamp {
  double brightness = 0.5;
  std::int64_t bulbs = 1;
  std::string colour = "white";
  std::vector<std::string> rooms{};
  std::vector<double> hours{}, watts{};
};

OptionTable<Lamp> const& lamp_table() {
  static OptionTable<Lamp> const table("lamp", "a lamp",
                                       {{"brightness", &Lamp::brightness, "1", 0.0, 1.0, "how bright"},
                                        {"bulbs", &Lamp::bulbs, "", 1, 8, "how many"},
                                        {"colour", &Lamp::colour, {"white", "warm"}, "which light"},
                                        {"rooms", &Lamp::rooms, "where"},
                                        {"hours", &Lamp::hours, {"unknown"}, "how old"},
                                        {"watts", &Lamp::watts, "how much"}});
  return table;
}

Section section_with(std::string const& key, OptionValue value) {
  Section section;
  section.name = "lamp";
  section.settings.push_back({key, std::move(value), {"job.toml", 3, 1, 4, ""}, {"job.toml", 3, 8, 3, ""}});
  return section;
}

std::vector<Problem> problems_of(std::string const& key, OptionValue value) {
  Lamp lamp;
  std::vector<Problem> problems;
  lamp_table().apply(section_with(key, std::move(value)), lamp, problems);
  return problems;
}

TEST(OptionTable, WritesTheMember) {
  Lamp lamp;
  std::vector<Problem> problems;
  lamp_table().apply(section_with("brightness", 0.25), lamp, problems);
  lamp_table().apply(section_with("bulbs", std::int64_t{4}), lamp, problems);
  lamp_table().apply(section_with("rooms", std::string("hall")), lamp, problems);
  EXPECT_TRUE(problems.empty());
  EXPECT_EQ(lamp.brightness, 0.25);
  EXPECT_EQ(lamp.bulbs, 4);
  EXPECT_EQ(lamp.rooms, std::vector<std::string>{"hall"});
}

TEST(OptionTable, WholeNumberServesAsNumberButNotTheReverse) {
  EXPECT_TRUE(problems_of("brightness", std::int64_t{1}).empty());
  EXPECT_EQ(problems_of("bulbs", 1.5).size(), 1u);
}

TEST(OptionTable, UnknownKeySuggestsTheClosest) {
  auto const problems = problems_of("brigthness", 0.1);
  ASSERT_EQ(problems.size(), 1u);
  EXPECT_EQ(problems[0].caret_note, "did you mean \"brightness\"?");
  EXPECT_EQ(problems[0].place.column, 1);
}

TEST(OptionTable, RangeAndWordsAreChecked) {
  EXPECT_EQ(problems_of("brightness", 1.5).at(0).help, "brightness takes 0 to 1");
  EXPECT_EQ(problems_of("colour", std::string("wram")).at(0).caret_note, "did you mean \"warm\"?");
  EXPECT_EQ(problems_of("brightness", std::numeric_limits<double>::quiet_NaN()).size(), 1u);
}

TEST(OptionTable, UnknownNumbersStandWhereAnOptionTakesThem) {
  double const unknown = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(problems_of("hours", std::vector<double>{0.0, unknown}).empty());
  EXPECT_TRUE(problems_of("hours", std::string("unknown")).empty());
  EXPECT_TRUE(problems_of("hours", std::vector<std::string>{"unknown", "unknown"}).empty());
  EXPECT_EQ(problems_of("hours", std::vector<std::string>{"unknown", "old"}).size(), 1u);
  EXPECT_EQ(problems_of("watts", std::vector<double>{0.0, unknown}).size(), 1u);
}

TEST(OptionTable, DescribesEveryOption) {
  auto const descriptions = lamp_table().describe();
  ASSERT_EQ(descriptions.size(), 6u);
  EXPECT_EQ(descriptions[0].default_value, "0.5");
  EXPECT_EQ(descriptions[2].range, "white | warm");
  EXPECT_EQ(descriptions[4].range, "numbers, \"unknown\"");
}

}  // namespace options_test
}  // namespace torquescope
