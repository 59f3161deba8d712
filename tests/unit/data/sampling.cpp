// What time stamps say: even, printed coarsely, jittered, repeated, missing, backwards.

#include "engine/data/sampling.hpp"

#include <cmath>

#include "engine/base/random_stream.hpp"
#include "unit/data/data_test_support.hpp"

namespace torquescope {
namespace sampling_test {

using data_test::problem_of;

RawTable table_of(std::size_t n_rows) {
  RawTable table;
  table.path = "arm.csv";
  for (std::size_t i = 0; i < n_rows; ++i) table.line_of_row.push_back(static_cast<std::int64_t>(i) + 2);
  return table;
}

Sampling analysed(std::vector<double> const& stamps) { return analyse_sampling(stamps, table_of(stamps.size())); }
Problem refused(std::vector<double> const& stamps) {
  return problem_of([&] { analysed(stamps); });
}

std::vector<double> even_stamps(double rate_hz, std::size_t n, double first = 0.0) {
  std::vector<double> stamps;
  for (std::size_t i = 0; i < n; ++i) stamps.push_back(first + static_cast<double>(i) / rate_hz);
  return stamps;
}

std::vector<double> printed(std::vector<double> stamps, double unit) {
  for (double& t : stamps) t = std::round(t / unit) * unit;
  return stamps;
}

TEST(Roundest, TakesTheFewestDigitsWithinTheTolerance) {
  EXPECT_EQ(roundest(1000.0000000005542, 1e-9), 1000.0);
  EXPECT_EQ(roundest(187.617, 0.005), 188.0);
  EXPECT_EQ(roundest(93.7, 0.1), 90.0);
  EXPECT_EQ(roundest(1.0 / 3, 0.0), 1.0 / 3);
}

TEST(Sampling, EvenStampsGiveTheirRateWhateverTheyBeginWith) {
  for (double rate : {48.0, 190.0, 1000.0, 1024.0, 8000.0, 1000.0 / 3})
    for (double first : {0.0, 17.25, 1.7e9}) {  // the last: seconds since 1970
      auto const sampling = analysed(even_stamps(rate, 5000, first));
      EXPECT_TRUE(sampling.even) << rate << " " << first;
      EXPECT_NEAR(sampling.rate_hz, rate, 1e-6 * rate) << first;
      EXPECT_EQ(sampling.rows.size(), 5000u);
      EXPECT_EQ(sampling.facts.repeated + sampling.facts.missing, 0);
    }
}

// 1024 Hz printed in ms has steps of 0 and 1 ms: the clock is even all the same
TEST(Sampling, RoundingOfPrintedStampsIsNoJitter) {
  auto const milliseconds = analysed(printed(even_stamps(1024, 20000), 1e-3));
  EXPECT_TRUE(milliseconds.even);
  EXPECT_NEAR(milliseconds.rate_hz, 1024, 0.01);
  auto const fast = analysed(printed(even_stamps(4000, 20000), 1e-3));  // every stamp four times
  EXPECT_TRUE(fast.even);
  EXPECT_EQ(fast.rate_hz, 4000);
  EXPECT_EQ(fast.facts.repeated, 0);
}

TEST(Sampling, JitterIsMeasuredAndTheRateIsTheMedianRounded) {
  RandomStream stream({22, 0, RandomDomain::test}, 0, 0);
  auto stamps = even_stamps(190, 3000);
  for (double& t : stamps) t += 0.03 / 190 * stream.normal();
  std::sort(stamps.begin(), stamps.end());
  auto const sampling = analysed(stamps);
  EXPECT_FALSE(sampling.even);
  EXPECT_EQ(sampling.rate_hz, 190);
  EXPECT_NEAR(sampling.facts.jitter, 0.03 * std::sqrt(2.0), 0.003);  // a step has the jitter of two stamps
}

TEST(Sampling, RepeatsAreDroppedAndMissingRowsCounted) {
  auto stamps = even_stamps(1000, 200);
  stamps.erase(stamps.begin() + 100, stamps.begin() + 103);
  stamps.insert(stamps.begin() + 50, stamps[50]);
  auto const sampling = analysed(stamps);
  EXPECT_FALSE(sampling.even);
  EXPECT_EQ(sampling.facts.repeated, 1);
  EXPECT_EQ(sampling.facts.missing, 3);
  EXPECT_EQ(sampling.rate_hz, 1000);
  EXPECT_EQ(sampling.rows.size(), 197u);
}

TEST(Sampling, RowsWrittenTwiceOnAnEvenClockLeaveItEven) {
  auto stamps = even_stamps(1000, 200);
  stamps.insert(stamps.begin() + 50, stamps[50]);
  auto const sampling = analysed(stamps);
  EXPECT_TRUE(sampling.even);
  EXPECT_EQ(sampling.facts.repeated, 1);
  EXPECT_EQ(sampling.rows.size(), 200u);
}

TEST(Sampling, BackwardsTimeNamesTheLineAndTheCut) {
  auto stamps = even_stamps(200, 2000);
  for (std::size_t i = 809; i < 2000; ++i) stamps[i] -= 0.01;
  auto const problem = refused(stamps);
  EXPECT_EQ(problem.code, ExitCode::bad_data);
  EXPECT_EQ(problem.what, "time runs backwards in line 811 (4.040 -> 4.035 s)");
  EXPECT_EQ(problem.place.line, 811);
  EXPECT_EQ(problem.help, "two recordings in one file? split it at line 811");
}

TEST(Sampling, LargeGapNamesItsPlace) {
  auto stamps = even_stamps(100, 500);
  for (std::size_t i = 200; i < 500; ++i) stamps[i] += 0.35;
  auto const problem = refused(stamps);
  EXPECT_EQ(problem.what, "35 samples are missing before line 202 (1.990 -> 2.350 s)");
  EXPECT_EQ(problem.help, "cut the recording there; up to 9 missing samples are interpolated");
}

TEST(Sampling, ClocksThatAreNoneAreRefused) {
  EXPECT_EQ(refused(std::vector<double>(50, 3.0)).what, "time stands still in arm.csv");
  auto const counts = refused(even_stamps(1, 100));
  EXPECT_EQ(counts.what, "the time step is 1 s: are the stamps counts or milliseconds?");
  EXPECT_NE(counts.help.find("write rate_hz"), std::string::npos);
}

}  // namespace sampling_test
}  // namespace torquescope
