// Noise of the torque channel is read from what the model leaves: how strong, how slow, and nothing of what is missing.

#include "engine/infer/replicates/torque_colour.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "engine/infer/replicates/octave_energies.hpp"
#include "unit/replicates/clean_records.hpp"

using namespace torquescope;
using namespace torquescope::test;

namespace torque_colour_test {

constexpr double coulomb = 1.3, white_std = 0.015 * coulomb;

TorqueColour colour_of(Recording const& recording) {
  auto const pipeline = clean_pipeline(recording);
  auto const made = make_baseline_twin(recording, pipeline, clean_filter(), {1e-4, 16, 1, 0}, 2);
  EXPECT_TRUE(made.colour);
  return made.colour.value_or(TorqueColour{});
}

// power per hertz at one frequency, both sides
double density(double white, double slow, double corner_hz, double f, double rate_hz = 1000.0) {
  double const memory = slow > 0.0 ? std::exp(-2.0 * std::numbers::pi * corner_hz / rate_hz) : 0.0;
  double const turn = 2.0 * std::numbers::pi * f / rate_hz;
  double const pole = 1.0 - 2.0 * memory * std::cos(turn) + memory * memory;
  return (white * white + slow * slow * (1.0 - memory * memory) / pole) / rate_hz;
}

double density(TorqueColour const& colour, double f) {
  return density(colour.white_std, colour.slow_std, colour.corner_hz, f);
}

TEST(TorqueColour, OfSlowNoiseIsWhatItWasMadeOf) {
  constexpr double slow_std = 0.02, corner_hz = 8.0;
  double ratio[3] = {};
  constexpr std::uint32_t records = 6;
  constexpr double frequencies[3] = {4.0, 10.0, 25.0};
  for (std::uint32_t i = 0; i < records; ++i) {
    auto const colour =
        colour_of(without_reference(recorded(simulate_joint(clean_joint().plan, 40 + i)), slow_std, corner_hz, i));
    EXPECT_GT(colour.slow_std, 0.0);
    for (std::size_t k = 0; k < 3; ++k)
      ratio[k] +=
          std::log(density(colour, frequencies[k]) / density(white_std, slow_std, corner_hz, frequencies[k])) / records;
  }
  // eight seconds hold some forty periods of the lowest: a quarter either way for the mean of six
  for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(ratio[k], 0.0, 0.25) << frequencies[k] << " Hz";
}

TEST(TorqueColour, OfWhiteNoiseIsFlat) {
  double low = 0.0, high = 0.0;
  constexpr std::uint32_t records = 6;
  for (std::uint32_t i = 0; i < records; ++i) {
    auto const colour = colour_of(without_reference(recorded(simulate_joint(clean_joint().plan, 60 + i)), 0.0, 8.0, i));
    low += std::log(density(colour, 4.0) / density(white_std, 0.0, 0.0, 4.0)) / records;
    high += std::log(density(colour, 25.0) / density(white_std, 0.0, 0.0, 25.0)) / records;
  }
  EXPECT_NEAR(low, 0.0, 0.25);
  EXPECT_NEAR(high, 0.0, 0.25);
}

TEST(TorqueColour, LeavesWhatIsMissingAlone) {
  // a drop of friction with speed, and cogging beside it, several times as strong as the noise
  auto const clean = without_reference(recorded(simulate_joint(clean_joint().plan, 71)), 0.0, 8.0, 0);
  auto missing = clean;
  Eigen::Index const n = clean.position.size();
  Eigen::ArrayXd velocity = Eigen::ArrayXd::Zero(n);
  velocity.segment(1, n - 2) =
      (clean.position.tail(n - 2) - clean.position.head(n - 2)).array() * (0.5 * clean.rate_hz);
  missing.torque.array() += 0.15 * coulomb * velocity.sign() * (-(velocity / 0.4).square()).exp();
  missing.torque.array() += 0.05 * coulomb * (20.0 * clean.position.array()).sin();
  double const added = (missing.torque - clean.torque).norm() / std::sqrt(static_cast<double>(n));
  auto const colour = colour_of(missing);
  EXPECT_LT(std::hypot(colour.white_std, colour.slow_std), 0.5 * added);
}

// differentiated twice, an encoder's noise is loud at the cut-off and silent below: no octave below may hear it
TEST(OctaveEnergies, HearSlowNoiseUnderThatOfAnEncoder) {
  auto const recording = recorded(simulate_joint(clean_joint().plan, 12));
  auto const pipeline = clean_pipeline(recording);
  ProcessedRecord const record = pipeline.process(recording);
  OctaveEnergies const energies(record, pipeline);
  ASSERT_GE(energies.count(), 3);
  std::mt19937 random(7);
  std::normal_distribution<double> normal;
  Eigen::Index const n = record.residual_itself().size();
  Eigen::VectorXd encoder(n), slow(n);
  double here = 0.0, before = 0.0, older = 0.0;
  double const memory = std::exp(-2.0 * std::numbers::pi * energies.lowest_hz() / pipeline.kept_rate_hz());
  for (Eigen::Index k = 0; k < n; ++k) {
    double const now = normal(random);
    encoder[k] = now - 2.0 * before + older;
    older = before;
    before = now;
    here = memory * here + std::sqrt(1.0 - memory * memory) * normal(random);
    slow[k] = 0.5 * here;
  }
  Eigen::MatrixXd signals(n, 2);
  signals << encoder, encoder + slow;
  Eigen::MatrixXd const found = energies.of(record, signals);
  EXPECT_LT(found(0, 1) / found(0, 0), 1.4) << "a twentieth of the energy";
  EXPECT_GT(found(2, 1) / found(2, 0), 2.0) << "and most of what is slow";
}

TEST(TorqueColour, IsNotAskedWhereAControllerTellsIt) {
  auto const recording = recorded(simulate_joint(clean_joint().plan, 12));
  auto const pipeline = clean_pipeline(recording);
  EXPECT_FALSE(make_baseline_twin(recording, pipeline, clean_filter(), {1e-4, 16, 1, 0}, 2).colour);
}

}  // namespace torque_colour_test
