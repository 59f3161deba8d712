#pragma once
// How well a model predicts rows that nothing was fitted to, beside the baseline, in the torque itself.
//
// Rows       those of the unseen recordings; without any, ten blocks of the training rows, each predicted by the fit
//            outside it (guarded). Where all laws belong to an instant or a clock: the rows where they act, in short
//            blocks
// Test       paired over blocks (held_out_gain.hpp)
// Share      of the mismatch's energy there, what the laws explain: (before - after) / (before - floor), the floor of
//            replicates; interval by the jackknife over blocks
// Units      energies in (N m)^2 or N^2
// Errors     as check_unseen
// Threads    spreads replicates over the setting's workers; same bits for any number
// Source     Diebold, Mariano 1995, doi:10.1080/07350015.1995.10524599; jackknife: Miller 1974,
//            doi:10.1093/biomet/61.1.1

#include <span>
#include <vector>

#include "engine/search/selection.hpp"
#include "engine/statistics/held_out_gain.hpp"
#include "engine/unseen/unseen_record.hpp"

namespace torquescope {

// with its 95 % interval
struct ExplainedShare {
  double share = unknown, low = unknown, high = unknown;
};

struct HeldOut {
  std::vector<UnseenResult> unseen{};              // one for each recording
  LeftOutRows left_out{};                          // by the mask, of all
  double before = 0.0, after = 0.0, torque = 0.0;  // energies over the unseen recordings
  HeldOutGain gain{};                              // of all laws
  HeldOutGain acting{};                            // where all are bound to the recording
  ExplainedShare explained{};
};

HeldOut held_out_errors(StageSetting const& setting, std::span<Recording const> unseen, Selection const& selection);

// noise: what a complete model would leave of every row
ExplainedShare explained_share(std::span<HeldOutBlock const> blocks, double noise);

}  // namespace torquescope
