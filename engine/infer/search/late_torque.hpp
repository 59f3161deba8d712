#pragma once
// What a torque channel that was read somewhere within its sample would explain by itself, beside a stage's model.
//
// Span       that of a row: a longer one is another law, which a drifting torque could exploit
// Threads    free functions
// Units      s; energies as MismatchEnergy

#include <optional>

#include "engine/infer/search/candidate_columns.hpp"
#include "engine/infer/search/model_stage.hpp"

namespace torquescope {

struct LateTorque {
  double late_s = 0.0, z = 0.0;
  double gain = 0.0;  // energy, less what chance gives
};

// no row says more of a torque than when it was read, to this many samples
inline constexpr double longest_timing = 1.1;

// columns: the stage's, on the common motion. Nothing where a delay has no column of its own, or the twins no noise
std::optional<LateTorque> late_torque(ModelStage const& stage, CandidateColumns const& columns, double rate_hz);

}  // namespace torquescope
