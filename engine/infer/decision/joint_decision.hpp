#pragma once
// The search for what is missing in the model of one joint, on all samples: six rules.
//
// Nuisances  a delay of the torque and the shape of reversals stand beside every model
// Score      D on rows that no fit has seen
// Chance     the largest gain over the catalogue in replicates of the model, each with its own sticking: p <= alpha
// Size       a torque of at least delta of the torque's rms, and no parameter beyond what it can be
// Validation other recordings are predicted better over all rows; where there are none, ten folds of training
// Ties       effects whose D lies within chance of an effect's, or whose judged error is not higher by least_fall, are
//            a class with it
// Clock      effects of an instant or a clock are asked after those of the motion, on short folds
// Errors     Error 78 for a filter that does not suit the recording, 65 where it is shorter than the filter
// Threads    spreads work over the question's threads; same bits for any number
// Source     engine/infer/decision/THEORY.md

#include "engine/infer/decision/fitted_model.hpp"

namespace torquescope {

struct JointDecision {
  DecisionFacts facts{};
  JointStrips rows{};
  FittedModel baseline{}, final{};  // look into the rows
  // residuals of replicates on rows of the first recording, a column each: of the model without effects, and of the
  // last one that was asked
  Eigen::MatrixXd baseline_replicates{}, final_replicates{};
};

JointDecision decide_joint(DecisionQuestion const& question);

}  // namespace torquescope
