#pragma once
// Prediction of a validation recording by the baseline and by the final model.
//
// Parameters least squares of the training rows, for both models: measured columns are attenuated alike
// Rows       those of the baseline's mask, for both models; with weights of reversals these rows are in, each counting
//            in every energy for as much as its weight says
// Nuisances  offset, phase of a single wave and share of a warm-up are refitted on the first 5 % of the recording when
//            beyond three standard errors, and reported. Events and drifts of a channel's zero are left out
// Promised   relative error of 16 replicates of this recording under the final model; floor: unseen_floor.hpp
// Units      SI
// Threads    spreads replicates over `threads`; same bits for any number
// Source     engine/infer/moving_rows/THEORY.md, Rows and replicates

#include <memory>
#include <optional>

#include "engine/fit/statistics/prediction_energies.hpp"
#include "engine/infer/pipeline/left_out_rows.hpp"
#include "engine/infer/search/selection.hpp"
#include "engine/infer/validation/unseen_nuisances.hpp"
#include "engine/infer/verdict/diagnosis.hpp"

namespace torquescope {

struct UnseenPrediction {
  double torque_energy = 0.0;
  PredictionEnergies energies{};                // of all effects together
  std::vector<Eigen::Index> kept_rows{};        // of the residuals, among the kept samples
  Eigen::VectorXd left_before{}, left_after{};  // residuals
  LeftOutRows left_out{};                       // by the mask
  Eigen::Index memory_rows = 1;                 // that repeat each other (guard_rows())
  std::vector<PredictionEnergies> by_effect{};  // without and with each, no offset refitted in either
  TorqueTrace trace{};
  std::vector<std::string> nuisances{};
  std::optional<ModelElsewhere> there{};  // the final model as that recording has it
  // all of them, when what processing makes of a complete model at reversals was taken out of the residuals
  // (unseen_floor.hpp)
  std::vector<Eigen::Index> rows{};
};

struct UnseenResult : UnseenPrediction {
  double promised = unknown, floor = unknown;  // relerr
  bool twins_ran_away = false;                 // of this recording, under the final model: no floor
  ForwardSimulation forward{};
};

// with floor and forward simulation. weights: of that recording's rows near reversals alone; none: they are masked
// Errors     as the pipeline; Error 65 when fewer than 100 rows are left between reversals
UnseenResult check_unseen(Recording const& recording, StageSetting const& setting, ModelStage const& baseline,
                          ModelStage const& augmented, std::shared_ptr<NoiseWeights const> weights = {});

// closed loop from the recording's reference, without noise, before and after; without a loop, or in one that follows
// the measured motion: unknown. there: the augmented model in that recording
ForwardSimulation simulate_forward(Recording const& recording, std::optional<RecordedLoop> const& loop,
                                   ModelStage const& baseline, ModelStage const& augmented,
                                   ModelElsewhere const& there);

// of the setting's own recording, with the parameters fitted to it
LeftOutRows left_out_in_training(StageSetting const& setting, ModelStage const& baseline, ModelStage const& augmented);

// torque and residuals on all kept samples; NaN where the mask has none
TorqueTrace torque_trace(Recording const& recording, RecordPipeline const& pipeline, ProcessedRecord const& before,
                         Eigen::VectorXd const& residual_before, Eigen::VectorXd const& residual_after);

// the recording with its time beginning at 0
Recording from_zero(Recording recording);

}  // namespace torquescope
