// Values that are no data are found wherever they lie, and no value of a sound signal is taken for one.

#include "engine/data/health/far_values.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "engine/data/health/lone_rows.hpp"

namespace torquescope {
namespace far_values_test {

std::vector<double> torque(double noise, double step = 0.0) {
  std::mt19937 engine(5);
  std::normal_distribution<double> normal;
  std::vector<double> values;
  for (int i = 0; i < 4000; ++i) {
    double const value = 3 * std::sin(0.01 * i) + (std::cos(0.01 * i) > 0 ? 1.0 : -1.0) + noise * normal(engine);
    values.push_back(step > 0.0 ? step * std::round(value / step) : value);
  }
  return values;
}

TEST(ValuesOutside, AreFoundHoweverMany) {
  for (std::size_t every : {2, 5, 95, 900}) {
    auto values = torque(0.02);
    std::vector<std::size_t> rows;
    for (std::size_t i = 40; i < values.size(); i += every) rows.push_back(i);
    for (std::size_t row : rows) values[row] = 9999;
    auto const found = values_outside(values);
    ASSERT_EQ(found.size(), 1U) << every;
    EXPECT_EQ(found.front().value, 9999);
    EXPECT_EQ(found.front().rows, rows);
  }
}

TEST(ValuesOutside, AreFoundBesideOneAnotherAndInARow) {
  auto values = torque(0.02);
  for (std::size_t i = 1000; i < 1004; ++i) values[i] = 1e30;
  for (std::size_t i = 2000; i < 2200; i += 50) values[i] = (i % 100 == 0 ? 1 : -1) * 999.0;
  auto const found = values_outside(values);
  ASSERT_EQ(found.size(), 3U);
  EXPECT_EQ(found[0].rows, (std::vector<std::size_t>{1000, 1001, 1002, 1003}));
  EXPECT_EQ(found[1].rows.size() + found[2].rows.size(), 4U);
}

TEST(ValuesInside, AreThoseThatTheRowsAroundContradict) {
  auto values = torque(0.02);
  std::vector<std::size_t> rows;
  for (std::size_t i = 40; i + 3 < values.size(); i += 110) rows.insert(rows.end(), {i, i + 1});
  for (std::size_t row : rows) values[row] = -5.5;
  EXPECT_TRUE(values_outside(values).empty());
  auto const found = values_inside(values);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found.front().value, -5.5);
  EXPECT_GE(found.front().rows.size(), rows.size() * 9 / 10);
}

// a noisy drive of coarse steps: some spikes agree by chance, and are no value of a driver
TEST(ValuesInside, AreNoneOfManySpikesOnACoarseScale) {
  constexpr double step = 0.05;
  auto values = torque(0.02, step);
  std::mt19937 engine(7);
  std::uniform_real_distribution<double> size(1.5, 2.5);
  for (std::size_t i = 40; i + 3 < values.size(); i += 37)
    values[i] = step * std::round((values[i - 1] - size(engine)) / step);
  EXPECT_TRUE(values_inside(values).empty());
  for (std::size_t i = 50; i + 3 < values.size(); i += 37) values[i] = -5.5;
  auto const found = values_inside(values);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found.front().value, -5.5);
}

TEST(FarValues, AreNoneOfASoundSignal) {
  for (double noise : {0.0, 0.02, 0.3})
    for (double step : {0.0, 0.01, 0.1, 0.5}) {
      auto values = torque(noise, step);
      EXPECT_TRUE(values_outside(values).empty()) << noise << " " << step;
      EXPECT_TRUE(values_inside(values).empty()) << noise << " " << step;
      for (double& value : values) value = std::clamp(value, -2.0, 2.0);  // a limit
      EXPECT_TRUE(values_outside(values).empty()) << noise << " " << step;
      EXPECT_TRUE(values_inside(values).empty()) << noise << " " << step;
      for (std::size_t i = 500; i < 1500; ++i) values[i] = 0.0;  // the drive is off
      EXPECT_TRUE(values_outside(values).empty()) << noise << " " << step;
      EXPECT_TRUE(values_inside(values).empty()) << noise << " " << step;
    }
}

TEST(LoneRows, StandOutFromBothNeighboursAndAreNoneOfASoundSignal) {
  for (double noise : {0.0, 0.02, 0.3})
    for (double step : {0.0, 0.01, 0.1}) {
      auto values = torque(noise, step);
      EXPECT_TRUE(lone_rows(values).empty()) << noise << " " << step;
      values[1234] += 20.0;
      EXPECT_EQ(lone_rows(values), std::vector<std::size_t>{1234}) << noise << " " << step;
    }
}

}  // namespace far_values_test
}  // namespace torquescope
