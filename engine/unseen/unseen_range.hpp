#pragma once
// Refuted effects, asked again where validation recordings stay within the motion of training.
//
// Why        a motion of a few degrees cannot tell a spring from a cable; a full turn then predicts nonsense with one
//            of them, which speaks against the training motion
// Rule       a twentieth of the rows lie beyond, and on the others (motion_range.hpp) the effects pass the test that
//            they fail on all of them (unseen_refutation.hpp); with fewer than 100 rows within they pass
// Not asked  where the training recording says itself that the effects are a part of something else
// Threads    spreads replicates over `threads`; same bits for any number

#include <optional>
#include <span>

#include "engine/pipeline/motion_range.hpp"
#include "engine/pipeline/recording_checks.hpp"
#include "engine/unseen/unseen_record.hpp"

namespace torquescope {

// the range of the training motion, when only rows beyond it refute the accepted effects
std::optional<MotionRange> spoils_only_beyond(StageSetting const& setting, std::span<Recording const> unseen,
                                              Selection const& selection);

// the verdict then; joint: with the accepted effects and the relative errors of the validation recordings
Hopeless too_narrow(JointDiagnosis const& joint, MotionRange const& trained);

}  // namespace torquescope
