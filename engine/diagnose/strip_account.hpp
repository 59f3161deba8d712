#pragma once
// What is drawn and told of a model on all samples: the mismatch map, where each effect acts, traces of torque.
//
// Rows       of the first training recording, those of the decision; quiet samples count nothing
// Replicates of the model, on the recording's rows: what a complete model leaves
// Units      SI
// Threads    free functions; the map spreads replicates over `threads`

#include "engine/diagnose/effect_account.hpp"
#include "engine/infer/decision/joint_decision.hpp"

namespace torquescope {

// residual: of the first recording's rows; replicates: [rows][M]
MismatchRows mismatch_rows(FittedModel const& by, Eigen::MatrixXd const& replicates);

// before, and after with the final model; empty where too few replicates were made
std::vector<MapAxis> map_of(JointDecision const& decision, int threads);

// of effect i of the final model
EffectAccount account_of(JointDecision const& decision, MismatchRows const& rows, std::size_t i);

// of the recordings to predict, else of training
std::vector<TorqueTrace> traces_of(JointDecision const& decision, DecisionQuestion const& question);

// squares that each replicate leaves of the first recording, over those that the recording leaves
std::vector<double> energies_of(FittedModel const& by, Eigen::MatrixXd const& replicates);

// shares of the baseline's energy in training: missing, unexplained, noise, beside what a simulator's numbers explain
Budget budget_of(JointDecision const& decision, double parameter_share);

}  // namespace torquescope
