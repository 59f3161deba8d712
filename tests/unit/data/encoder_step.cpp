// The encoder's step where the file blurs it, and none where a slow source only looks like one.

#include "engine/data/encoder_step.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

namespace torquescope {
namespace encoder_step_test {

constexpr double step = 2.0 * std::numbers::pi / (1 << 17);

double to_grid(double value, double grid) { return grid * std::round(value / grid); }

// a joint that turns round now and then, read by an encoder
std::vector<double> readings() {
  std::vector<double> values(20000);
  for (std::size_t k = 0; k < values.size(); ++k) {
    double const t = static_cast<double>(k) / 500.0;
    values[k] = to_grid(0.7 * std::sin(1.3 * t) + 0.2 * std::sin(3.1 * t) + 3.0, step);
  }
  return values;
}

TEST(EncoderStep, IsFoundInExactReadings) { EXPECT_NEAR(shown_step(readings()) / step, 1.0, 1e-6); }

TEST(EncoderStep, IsFoundThroughPrintedDigitsAndAnUnwrappedTurn) {
  auto values = readings();
  for (std::size_t k = 0; k < values.size(); ++k)
    values[k] = to_grid(values[k], 1e-6) + (k > values.size() / 2 ? 6.283185307 : 0.0);
  EXPECT_NEAR(shown_step(values) / step, 1.0, 0.05);
}

TEST(EncoderStep, IsFoundWhereReadingsAreCountedOnAnotherGrid) {
  constexpr double counts = 2.0 * std::numbers::pi / (8192 * 30);
  auto values = readings();
  for (auto& value : values) value = to_grid(value, counts);
  EXPECT_NEAR(shown_step(values), step, counts);
}

TEST(EncoderStep, IsNotWhatASlowSourceMovesBetweenTwoReadings) {
  std::vector<double> values(20000);
  for (std::size_t k = 0; k < values.size(); ++k) {
    double const t = static_cast<double>(k - k % 10) / 500.0;
    values[k] = 0.7 * std::sin(1.3 * t) + 0.2 * std::sin(3.1 * t);
  }
  EXPECT_EQ(shown_step(values), 0.0);
}

TEST(EncoderStep, OfARecordingIsWhatItsFileTold) {
  Recording recording;
  auto const values = readings();
  recording.position = Eigen::Map<Eigen::VectorXd const>(values.data(), static_cast<Eigen::Index>(values.size()));
  EXPECT_NEAR(encoder_step(recording) / step, 1.0, 1e-6);
  recording.rows.encoder_step = 1e-3;
  EXPECT_EQ(encoder_step(recording), 1e-3);
}

}  // namespace encoder_step_test
}  // namespace torquescope
