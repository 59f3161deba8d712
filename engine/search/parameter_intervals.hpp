#pragma once
// Parameters of a model with 95 % intervals from its twins: all of them jointly, shapes included.
//
// Equation   deviation of twin t = [columns | tangents]^+ (its torque - columns * the truth it was simulated with);
//            interval = value -+ the larger of 1.96 standard deviations over twins * sqrt(1 + 1/M) and 2.26 of the
//            block jackknife on the recording's own mismatch (block_jackknife.hpp), over tenths of the record and, for
//            the parameters of an effect, over tenths along its axis (axis_blocks.hpp): a law that is not quite the
//            joint's is no chance. What the model leaves beyond noise could have moved them as well: its shift
//            (law_discrepancy.hpp) is added in squares. Tenths of the record know a part of it; counted twice that is
//            wide, not short
//            Shapes stay inside their bounds, and what the fit bounds by its sign above none, in every twin and without
//            every block, as they do in the fit: what they cannot be moves no other parameter Instants and places: as
//            far as their profile goes where that is further (profiled_interval.hpp)
// Value      corrected for the bias of processing (baseline_correction.hpp); shapes by the last step of
//            joint_refinement.hpp
// Threads    free function
// Source     PHYSICS.md section 2 step 12; parametric bootstrap: Efron, Tibshirani 1993

#include <vector>

#include "engine/search/model_stage.hpp"
#include "engine/verdict/diagnosis.hpp"

namespace torquescope {

struct ModelEstimate {
  std::vector<ParameterEstimate> baseline{};              // of the regressor
  std::vector<std::vector<ParameterEstimate>> effects{};  // of each effect: linear ones, then shapes
};

// standard deviation over twins, bounds or not: columns of the model first, then one per tangent
Eigen::VectorXd parameter_deviations(ModelStage const& stage, CandidateColumns const& columns);

ModelEstimate estimate_parameters(ModelStage const& stage);

}  // namespace torquescope
