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

TEST(Sampling, LargeGapsAreKeptWithTheirEnds) {
  auto stamps = even_stamps(100, 500);
  for (std::size_t i = 200; i < 500; ++i) stamps[i] += 0.35;
  auto const sampling = analyse_sampling(stamps, table_of(stamps.size()));
  ASSERT_EQ(sampling.gaps.size(), 1u);
  EXPECT_NEAR(sampling.gaps[0].from_s, 1.99, 1e-9);
  EXPECT_NEAR(sampling.gaps[0].until_s, 2.35, 1e-9);
}

TEST(Sampling, GapsLongerThanTheRowsAreRefused) {
  auto stamps = even_stamps(100, 500);
  for (std::size_t i = 200; i < 500; ++i) stamps[i] += 60.0;
  EXPECT_EQ(refused(stamps).what, "6000 samples are missing before line 202, more than the recording has");
}

TEST(Sampling, ClocksThatAreNoneAreRefused) {
  EXPECT_EQ(refused(std::vector<double>(50, 3.0)).what, "time stands still in arm.csv");
}

// stamps of 5000 s and more in single precision are half a millisecond apart
TEST(Sampling, StampsOfSinglePrecisionAreEven) {
  auto stamps = even_stamps(500, 5000);
  for (double& stamp : stamps) stamp = static_cast<double>(static_cast<float>(stamp + 5000.0));
  double const unit = single_precision_unit(stamps);
  EXPECT_DOUBLE_EQ(unit, 0x1p-11);
  for (double& stamp : stamps) stamp -= 5000.0;
  auto const sampling = analyse_sampling(stamps, table_of(stamps.size()), unit);
  EXPECT_TRUE(sampling.even);
  EXPECT_NEAR(sampling.rate_hz, 500.0, 0.01);
}

// nine digits, as printf("%.9g") keeps every float
TEST(Sampling, PrintedStampsOfSinglePrecisionAreEven) {
  auto stamps = even_stamps(500, 5000);
  for (double& stamp : stamps) {
    double const single = static_cast<double>(static_cast<float>(stamp + 5000.0));
    stamp = std::round(single * 1e5) / 1e5;
  }
  double const unit = single_precision_unit(stamps);
  EXPECT_DOUBLE_EQ(unit, 0x1p-11);
  EXPECT_NEAR(analyse_sampling(stamps, table_of(stamps.size()), unit).rate_hz, 500.0, 0.01);
  stamps[100] += 1e-4;  // no float, by a fifth of their spacing
  EXPECT_EQ(single_precision_unit(stamps), 0.0);
}

}  // namespace sampling_test
}  // namespace torquescope
