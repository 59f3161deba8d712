#pragma once
// Mismatches whose effect is known: what a complete model leaves of a simulated recording, and one effect of drawn
// shape.
//
// Equation   mismatch = (residual - mean replicate) of the clean recording + columns(shape) * linear, on the common
//            rows
// Recording  clean_joint() for 4 s in closed loop, with its encoder and its noise; baseline inertia, viscous, coulomb,
//            offset
// Law        shape: uniform over the middle three fifths of every range, in the unit scale; linear parameters: the same
//            share of each one's plausible bounds, signs drawn where both are allowed; so large that the rms of what
//            the baseline cannot take up is `loudness` times the rms of what the clean recording leaves. Drawn again
//            where that asks for more than half of the plausible bounds
// Errors     std::runtime_error when no draw will do
// Units      SI
// Random     addressed by (recording, effect); simulated recordings by their number
// Threads    plain records; CleanStage spreads its replicates over `threads`

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "engine/infer/search/candidate_columns.hpp"
#include "engine/infer/search/model_stage.hpp"

namespace torquescope::test {

inline constexpr double loudness = 5.0;

// one clean recording with its replicates; the parts look into each other
struct CleanStage {
  CleanStage(std::uint32_t number, int threads);
  CleanStage(CleanStage const&) = delete;
  CleanStage& operator=(CleanStage const&) = delete;

  std::uint32_t const number;
  Recording const recording;
  FilterOptions const filter;
  Section const section{};
  ModelStage const stage;
  CandidateColumns const columns;
};

struct PlantedMismatch {
  CandidateColumns const* columns = nullptr;
  Effect const* effect = nullptr;
  std::vector<double> shape{};  // the truth
  Eigen::VectorXd linear{};     // the truth
  Eigen::VectorXd mismatch{};   // n rows
  Eigen::VectorXd baseline{};   // as fitted to the clean recording; the mismatch may move it
};

PlantedMismatch planted_mismatch(CleanStage const& clean, Effect const& effect);

// plausible sizes of an effect's linear parameters; one without a bound gives at most the torque's rms there, its
// column taken in the middle of its shapes
std::vector<ParameterRange> linear_box(CandidateColumns const& columns, Effect const& effect);
// how far the mismatch may move each parameter of the baseline: by its own size, or by a tenth of the torque's rms if
// that is more
std::vector<ParameterRange> baseline_box(PlantedMismatch const& planted);

}  // namespace torquescope::test
