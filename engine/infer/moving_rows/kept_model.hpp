#pragma once
// The longest part of the search whose laws predict held-out rows better: the model that the verdict speaks of.
//
// Better     the held-out error falls clearly (paired test): where the laws act, or all over the recording for a model
//            that is not adequate; such a model must explain more of the mismatch than it leaves
// All rows   the error of validation recordings over all samples, reversals and rests too, does not rise
// Shorter    where the part without the last step stands too, that step must lower the error clearly once more, unless
//            its law belongs to a clock
// Bound      laws that all belong to an instant or a clock predict little elsewhere: their error falls where they act,
//            that of unseen recordings does not rise clearly, and the model is adequate with them
// None       where no part does: the whole search, whose names are withdrawn
// Threads    as held_out_errors
// Source     engine/infer/moving_rows/THEORY.md, Verdict

#include <span>

#include "engine/infer/moving_rows/held_out.hpp"
#include "engine/infer/moving_rows/stepwise.hpp"

namespace torquescope {

struct KeptModel {
  SearchState state{};
  HeldOut held_out{};
  bool is_held_out_lower = false;  // clearly
  bool explains_most = false;
  double fall = 0.0;  // of the held-out error, as a share of it; of laws of a clock alone, where they act
};

KeptModel keep_what_predicts(StepwiseSearch const& search, OtherRecordings const& others);

}  // namespace torquescope
