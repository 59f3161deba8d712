#include "engine/data/column_look.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace torquescope {
namespace column_look_test {

// columns a: time, b: position, c: torque of it, d: speed, e: noise, f: zero
RawTable bare_table(double rate_hz, double encoder_step) {
  std::mt19937 engine(3);
  std::normal_distribution<double> normal;
  RawTable table;
  table.names = {"a", "b", "c", "d", "e", "f"};
  table.columns.resize(6);
  for (int k = 0; k < static_cast<int>(20 * rate_hz); ++k) {
    double const t = k / rate_hz, q = 0.8 * std::sin(2.3 * t) + 0.3 * std::sin(5.1 * t + 1);
    double const dq = 1.84 * std::cos(2.3 * t) + 1.53 * std::cos(5.1 * t + 1);
    double const ddq = -4.232 * std::sin(2.3 * t) - 7.803 * std::sin(5.1 * t + 1);
    std::vector<double> const row{t,
                                  encoder_step * std::round(q / encoder_step),
                                  0.1 * ddq + 0.3 * dq + (dq > 0 ? 0.5 : -0.5) + 0.02 * normal(engine),
                                  dq,
                                  normal(engine),
                                  0.0};
    for (std::size_t c = 0; c < row.size(); ++c) table.columns[c].push_back(row[c]);
  }
  return table;
}

TEST(ColumnLooks, TellClockPositionSpeedAndTorqueByTheirValues) {
  for (double const rate_hz : {30.0, 500.0})
    for (double const encoder_step : {1e-5, 1e-3}) {
      SCOPED_TRACE(rate_hz);
      auto const looks = column_looks(bare_table(rate_hz, encoder_step));
      ASSERT_EQ(looks.size(), 6u);
      EXPECT_EQ(looks[0].look, Look::clock);
      EXPECT_NEAR(looks[0].step, 1 / rate_hz, 1e-9);
      EXPECT_EQ(looks[1].look, Look::position);
      EXPECT_EQ(looks[2].look, Look::torque);
      EXPECT_EQ(looks[2].of, "b");
      EXPECT_GT(looks[2].likeness, 0.8);
      EXPECT_EQ(looks[3].look, Look::derivative);
      EXPECT_EQ(looks[3].of, "b");
      EXPECT_EQ(looks[4].look, Look::like_none);
      EXPECT_EQ(looks[5].look, Look::constant);
    }
}

}  // namespace column_look_test
}  // namespace torquescope
