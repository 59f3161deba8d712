#pragma once
// One recording beside the replicates of one model, as every question of the search sees it: signals on rows.
//
// Signals    column 0: what the model leaves of the recording, less the replicates' mean; then each replicate less the
//            mean, scaled so that all columns have the same variance when the model is right
// Training   residuals of the fit; nuisance columns (model and tangents of its shapes) are fitted with every candidate
// Unseen     residuals of the prediction by the fit of training (a replicate's: by the fit of its training replicate),
//            whitened as training is; a record's own offset, effects that run down (CarryOver::in_part), waves per
//            second (in_frequency), of any size, and its own events (search/own_event.hpp) are nuisances of the record
//            and are taken out of all signals
// Shapes     n rows, M replicates: n x (M + 1)
// Errors     none: a recording whose replicates cannot be made gives no evidence; what is left of it is known all the
//            same
// Threads    spreads replicates over the setting's workers; same bits for any number; then const
// Source     engine/infer/moving_rows/THEORY.md, Rows and replicates

#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "engine/infer/search/candidate_columns.hpp"
#include "engine/infer/search/model_stage.hpp"

namespace torquescope {

// first column the recording, then the replicates (as above); left: n, twins: n x M
Eigen::MatrixXd exchangeable(Eigen::VectorXd const& left, Eigen::MatrixXd const& twins);

// of effect i of the model on the rows of `columns`, whitened; 0 for none of them
Eigen::VectorXd torque_of(ModelStage const& stage, CandidateColumns const& columns, std::size_t i);

// of a validation recording
struct UnseenEvidence {
  std::shared_ptr<RecordPipeline const> pipeline{};  // restricted to the common rows
  std::shared_ptr<TwinComparison const> comparison{};
  std::shared_ptr<CandidateColumns const> columns{};
  Eigen::MatrixXd signals{};     // n x (M + 1); moved from by Evidence
  Eigen::MatrixXd nuisance{};    // n x k: what a step of training's orthonormal nuisance columns is here
  Eigen::MatrixXd model{};       // n x p: columns of the model and tangents of its shapes, as far as they act here
  Eigen::VectorXd offset{};      // n: unit vector of the record's own offset; empty where the model has none
  Eigen::MatrixXd own{};         // n x any, orthonormal: all nuisances of the record
  Eigen::Index memory_rows = 1;  // that repeat each other
  Eigen::MatrixXd without_own(Eigen::MatrixXd signals) const;
};

// training: columns of the stage on training; index: of the recording among all, 1 and up, for its random numbers
std::optional<UnseenEvidence> unseen_evidence(StageSetting const& setting, ModelStage const& stage,
                                              CandidateColumns const& training, Recording const& recording,
                                              std::uint32_t index);

// of a recording without replicates: energy of what training's fit leaves, whitened, and its rows; 0 rows: none
struct UnseenResidual {
  double left = 0.0, torque = 0.0;
  Eigen::Index rows = 0;
};
UnseenResidual unseen_residual(StageSetting const& setting, ModelStage const& stage, Recording const& recording);

// columns of an event where it happens in that recording, n x L, less the record's nuisances; left: n, what training's
// parameters leave. None: it does not happen there, as far as chance lets tell
Eigen::MatrixXd own_event_columns(UnseenEvidence const& of, Effect const& event, Eigen::VectorXd const& left,
                                  std::uint64_t seed);

// the same where effect `without` of the model is a candidate again: no nuisance, and its torque is in the recording's
// signal. training: columns of the stage without it
UnseenEvidence without_effect(UnseenEvidence of, ModelStage const& stage, CandidateColumns const& training,
                              std::size_t without, std::uint64_t seed);

}  // namespace torquescope
