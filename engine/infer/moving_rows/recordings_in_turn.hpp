#pragma once
// Training recordings predicted in turn, each by the fit to all others: cross-validation where there are several.
//
// Rows       of the baseline's mask, for both models, in the torque itself; reversals of further recordings are masked
// Own        a recording's offset is its own, where the model has one: its mean is taken out of torque and columns
// Clock      laws of a clock, or that run down, act in the recording that they were found in alone
// Units      energies in (N m)^2 or N^2
// Errors     as the pipeline
// Threads    free function
// Source     leave-one-out: Stone 1974, doi:10.1111/j.2517-6161.1974.tb00994.x

#include <Eigen/Core>
#include <span>
#include <vector>

#include "engine/infer/search/selection.hpp"

namespace torquescope {

struct RecordingInTurn {
  Eigen::VectorXd before{}, after{};  // what baseline and final model leave, a row each
  Eigen::Index memory_rows = 1;       // rows that repeat each other
};

struct RecordingsInTurn {
  std::vector<RecordingInTurn> recordings{};       // the first, then the further ones
  double torque = 0.0;                             // energy
  double fitted_before = 0.0, fitted_after = 0.0;  // energies that one fit to all of them leaves
};

// further: one or more, beside the setting's own recording
RecordingsInTurn recordings_in_turn(StageSetting const& setting, std::span<Recording const> further,
                                    Selection const& selection);

}  // namespace torquescope
