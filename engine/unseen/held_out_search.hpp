#pragma once
// The search, until its names hold on rows they were not fitted to: what spoils them is left out and the search goes
// on.
//
// Rounds     at most three without what spoiled the round before; then the names of the first round are refused
// Beyond     where unseen recordings spoil the names only beyond the training motion (unseen_range.hpp) nothing is
//            searched on: the motion is to blame
// Last       laws of an instant or a clock are tried last. Where names with such a law are refused, the first round is
//            one without any of them. Where they hold, in whichever round, in a model that is not adequate, such a
//            search is made too, and wins unless its held-out error is clearly higher
// Threads    as the stages

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "engine/pipeline/motion_range.hpp"
#include "engine/unseen/held_out_judgement.hpp"

namespace torquescope {

struct HeldOutSelection {
  Selection selection;
  Remainder remainder{};
  std::unique_ptr<StageSetting const> setting;  // of the stages
  HeldOutJudgement judgement{};
  std::optional<MotionRange> kept_to{};  // by training, where only what is beyond speaks against the names
};

// selection: of the search on all candidates, in time (joint_search.hpp)
HeldOutSelection search_while_names_spoil(StageSetting const& setting, SelectionOptions const& options,
                                          std::span<Recording const> unseen, Selection selection,
                                          StageSink const& progress);

}  // namespace torquescope
