#pragma once
// Energies in the unweighted torque: weighted rows hide what goes with dry friction, whose level may walk, however
// large
// its change over time is (METHOD.md, Weights of rows).
//
// Beside     of an effect: what the model's own columns cannot take up
// Units      (N m)^2 or N^2, summed over rows
// Threads    free functions

#include <Eigen/Core>
#include <span>

#include "engine/search/candidate_columns.hpp"
#include "engine/search/model_stage.hpp"

namespace torquescope {

// an effect of some shape and size, on the columns it was found on
struct SizedEffect {
  Effect const& effect;
  std::span<double const> shape;
  Eigen::VectorXd const& parameters;  // linear
};

// of the residual, beyond noise
double excess_in_torque_itself(ModelStage const& stage);
// of the effect's torque, beside the model of the stage
double energy_beside(ModelStage const& stage, CandidateColumns const& columns, SizedEffect const& effect);
// that the mismatch of the stage loses by it
double gain_in_torque_itself(ModelStage const& stage, CandidateColumns const& columns, SizedEffect const& effect);

}  // namespace torquescope
