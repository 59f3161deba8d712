#include "engine/data/stamp_guess.hpp"

#include <gtest/gtest.h>

#include "engine/data/ros_stamp.hpp"

namespace torquescope {
namespace stamp_guess_test {

// 100 stamps
std::vector<double> stamps(double first, double step) {
  std::vector<double> values;
  for (int k = 0; k < 100; ++k) values.push_back(first + k * step);
  return values;
}

std::optional<StampGuess> guess(std::string const& name, std::vector<double> const& values) {
  RawTable table;
  table.names = {name};
  table.columns = {values};
  return guess_stamps(table);
}

TEST(StampGuess, BelievesTheUnitOfTheNameWhereItFits) {
  EXPECT_EQ(guess("t_s", stamps(0, 0.002))->per_unit, 1.0);
  EXPECT_EQ(guess("t_ms", stamps(0, 0.25))->per_unit, 1e-3) << "4 kHz";
  EXPECT_EQ(guess("time [us]", stamps(0, 500))->per_unit, 1e-6);
  EXPECT_EQ(guess("t_ms", stamps(0, 0.25))->unit, Certainty::by_name);
}

TEST(StampGuess, DoubtsANameThatTheStepContradicts) {
  auto const odd = guess("t_s", stamps(0, 2.0));
  EXPECT_EQ(odd->per_unit, 1e-3);
  EXPECT_EQ(odd->unit, Certainty::doubtful);
}

TEST(StampGuess, KnowsStampsSince1970) {
  for (auto const& [first, step, per_unit] :
       {std::tuple{1.7e9, 0.01, 1.0}, {1.7e12, 10.0, 1e-3}, {1.7e15, 1e4, 1e-6}, {1.7e18, 1e7, 1e-9}}) {
    auto const found = guess("timestamp", stamps(first, step));
    EXPECT_EQ(found->per_unit, per_unit) << first << " " << step;
    EXPECT_EQ(found->unit, Certainty::sure);
  }
}

TEST(StampGuess, TellsUnitsByTheStep) {
  EXPECT_EQ(guess("time", stamps(0, 0.002))->per_unit, 1.0);
  EXPECT_EQ(guess("time", stamps(0, 5))->per_unit, 1e-3);
  EXPECT_EQ(guess("time", stamps(0, 1000))->per_unit, 1e-6);
  EXPECT_EQ(guess("time", stamps(0, 2e6))->per_unit, 1e-9);
  EXPECT_EQ(guess("time", stamps(0, 1))->unit, Certainty::doubtful) << "it may count rows";
}

TEST(StampGuess, SecondsBesideNanosecondsAreNoStamp) {
  RawTable table;
  table.names = {"stamp.sec", "stamp.nanosec", "stamp"};
  table.columns = {{1768472944, 1768472944, 1768472945, 1768472945}, {5e8, 9e8, 3e8, 7e8}, {0.5, 0.9, 1.3, 1.7}};
  auto const found = guess_stamps(table);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->column, "stamp") << "their sum, as readers add it";
}

TEST(StampGuess, NanosecondsOfAJoinedStampAreNoStamp) {
  RawTable table;
  table.names = {"stamp.sec", "stamp.nanosec"};
  table.columns = {{}, {}};
  for (int k = 0; k < 600; ++k) {  // so long that few of them run backwards
    table.columns[0].push_back(1768472944 + (k + 250) / 500);
    table.columns[1].push_back(2e6 * ((k + 250) % 500));
  }
  EXPECT_EQ(guess_stamps(table)->column, "stamp.nanosec") << "nothing better";
  add_ros_stamps(table);
  EXPECT_EQ(guess_stamps(table)->column, "stamp");
}

TEST(StampGuess, BelievesARowOfUnits) {
  RawTable table;
  table.names = {"time"};
  table.units = {"ms"};
  table.columns = {stamps(0, 2)};
  EXPECT_EQ(guess_stamps(table)->per_unit, 1e-3);
  EXPECT_EQ(guess_stamps(table)->unit, Certainty::by_name);
}

TEST(StampGuess, FindsNothingInAColumnThatStandsStillOrGoesBack) {
  EXPECT_FALSE(guess("time", std::vector<double>(100, 3.0)));
  EXPECT_FALSE(guess("time", stamps(1, -0.01)));
  EXPECT_FALSE(guess("k", stamps(0, 1)));
}

}  // namespace stamp_guess_test
}  // namespace torquescope
