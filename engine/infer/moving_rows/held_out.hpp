#pragma once
// How well a model predicts rows that nothing was fitted to, beside the baseline, in the torque itself.
//
// Rows       those of the unseen recordings; without any, each training recording by the fit to the others, or ten
//            blocks of the only one, each by the fit outside it (guarded). Where all laws belong to an instant or a
//            clock: the rows where they act, in short blocks
// Reversals  where their rows are weighed, they count for as much as their weights say
// Test       paired over blocks (held_out_gain.hpp): all alike, or where the laws act
// Share      of the mismatch's energy there, what the laws explain: (before - after) / (before - floor), the floor of
//            replicates; interval by the jackknife over blocks
// Units      energies in (N m)^2 or N^2
// Errors     as check_unseen
// Threads    spreads replicates over the setting's workers; same bits for any number
// Source     Diebold, Mariano 1995, doi:10.1080/07350015.1995.10524599; jackknife: Miller 1974,
//            doi:10.1093/biomet/61.1.1

#include <memory>
#include <span>
#include <vector>

#include "engine/fit/statistics/held_out_gain.hpp"
#include "engine/infer/moving_rows/evidence.hpp"
#include "engine/infer/moving_rows/recordings_in_turn.hpp"
#include "engine/infer/pipeline/noise_weights.hpp"
#include "engine/infer/search/selection.hpp"
#include "engine/infer/validation/unseen_record.hpp"

namespace torquescope {

// with its 95 % interval
struct ExplainedShare {
  double share = unknown, low = unknown, high = unknown;
};

// residuals of one recording, a row each
struct HeldOutRows {
  Eigen::VectorXd left{};
  Eigen::Index memory_rows = 1;
};

struct HeldOut {
  std::vector<UnseenResult> unseen{};              // one for each recording
  LeftOutRows left_out{};                          // by the mask, of all
  double before = 0.0, after = 0.0, torque = 0.0;  // energies over the unseen recordings
  std::vector<HeldOutRows> left{};                 // by the model with all laws
  HeldOutGain gain{};                              // of all laws
  HeldOutGain acting{};                            // where all are bound to the recording
  ExplainedShare explained{};
};

// weights: one for each unseen recording; none: its rows near reversals are masked
HeldOut held_out_errors(StageSetting const& setting, OtherRecordings const& others, Selection const& selection,
                        std::span<std::shared_ptr<NoiseWeights const> const> weights, Blocks which);

// noise: what a complete model would leave of every row
ExplainedShare explained_share(std::span<HeldOutBlock const> blocks, double noise);

// over all unseen recordings, what a complete model would leave there, as a share of their torque; NaN where no
// replicates could tell
double floor_of(HeldOut const& held_out);

}  // namespace torquescope
