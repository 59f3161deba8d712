#pragma once
// Parameters of a model with 95 % intervals from its replicates: all jointly, shapes included (METHOD.md, Intervals).
//
// Equation   deviation of replicate t = [columns | tangents]^+ (its torque - columns * the truth it was simulated with)
//            half width^2 = max(1.96 sd sqrt(1 + 1/M), 2.26 se of the block jackknife)^2 + law_discrepancy^2
// Jackknife  over tenths of the record and, for an effect, over tenths along its axis (block_jackknife,
//            axis_blocks.hpp)
// Several    training recordings: deviations and jackknife of one fit to all of them (ModelStage::pooled)
// Bounds     shapes and signs stay within their bounds in every replicate and without every block, as in the fit
// Instants   and places: as far as their profile goes, where that is further (profiled_interval.hpp)
// Value      corrected for bias (baseline_correction.hpp); shapes by the last step of joint_refinement.hpp
// Threads    free function
// Source     parametric bootstrap: Efron, Tibshirani 1993, doi:10.1201/9780429246593

#include <vector>

#include "engine/infer/search/model_stage.hpp"
#include "engine/infer/verdict/diagnosis.hpp"

namespace torquescope {

struct ModelEstimate {
  std::vector<ParameterEstimate> baseline{};              // of the regressor
  std::vector<std::vector<ParameterEstimate>> effects{};  // of each effect: linear ones, then shapes
};

// standard deviation over twins, bounds or not: columns of the model first, then one per tangent
Eigen::VectorXd parameter_deviations(ModelStage const& stage, CandidateColumns const& columns);

ModelEstimate estimate_parameters(ModelStage const& stage);

}  // namespace torquescope
