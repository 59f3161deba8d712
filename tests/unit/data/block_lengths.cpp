// Signals of several lengths in one file, each with a clock of its own.

#include "engine/data/block_lengths.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "engine/base/error.hpp"
#include "engine/data/clock_blocks.hpp"
#include "engine/data/table_builder.hpp"

namespace torquescope {
namespace block_lengths_test {

std::vector<double> stamps(std::size_t n, double rate_hz) {
  std::vector<double> values;
  for (std::size_t k = 0; k < n; ++k) values.push_back(static_cast<double>(k) / rate_hz);
  return values;
}

std::vector<double> wave(std::size_t n, double rate_hz) {
  std::vector<double> values = stamps(n, rate_hz);
  for (double& value : values) value = std::sin(3 * value);
  return values;
}

RawTable two_rates(bool with_clock_of_torque) {
  TableBuilder builder("two.npz", "");
  builder.add("q", wave(400, 100));
  builder.add("tq", stamps(400, 100));
  builder.add("tau", wave(100, 25));
  if (with_clock_of_torque) builder.add("ttau", stamps(100, 25));
  builder.add("gain", {3.0});
  return std::move(builder).finish();
}

RecordingOptions options(std::string const& time) {
  RecordingOptions options;
  options.columns = {{"time", time}, {"position", "q"}, {"torque", "tau"}};
  return options;
}

TEST(BlockLengths, EachSignalHasTheClockOfItsLength) {
  auto const table = two_rates(true);
  EXPECT_EQ(table.names, (std::vector<std::string>{"tq", "q", "ttau", "tau"}));
  EXPECT_EQ(table.lengths, (std::vector<std::size_t>{400, 400, 100, 100}));
  EXPECT_TRUE(std::isnan(table.columns[3][100]));
  EXPECT_EQ(clocks_of_columns(table).at("tau"), "ttau");
  EXPECT_EQ(block_of(table, "tau").columns.front().size(), 100u);
}

TEST(BlockLengths, WithoutAClockOfItsLengthASignalIsRefusedWithBoth) {
  auto const table = two_rates(false);
  EXPECT_TRUE(table.lengths.empty());
  ASSERT_EQ(table.unusable.front().name, "tau");
  EXPECT_EQ(table.unusable.front().reason,
            "has 100 values where the signals have 400, and no time stamps of its own: a vector of 100");
}

TEST(BlockLengths, AChannelIsHeldToTheLengthOfItsClock) {
  auto const table = two_rates(true);
  auto given = options("tq");
  try {
    check_block_lengths(table, given);
    FAIL() << "a torque of another length";
  } catch (Error const& refused) {
    EXPECT_EQ(refused.problems().front().what, "\"tau\" has 100 values, and \"tq\" has 400");
    EXPECT_EQ(refused.problems().front().help, "clocks = {torque = \"ttau\"} in [recording]");
  }
  given.clocks = {{"torque", "ttau"}};
  EXPECT_NO_THROW(check_block_lengths(table, given));
}

// two recordings one after the other are no channels of one
TEST(BlockLengths, ClocksOfDifferentTimesAreNoBlocks) {
  EXPECT_TRUE(run_together(stamps(100, 25), stamps(400, 100)));
  auto later = stamps(100, 25);
  for (double& value : later) value += 100;
  EXPECT_FALSE(run_together(later, stamps(400, 100)));
}

}  // namespace block_lengths_test
}  // namespace torquescope
