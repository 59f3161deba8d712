#pragma once
// Names that unseen recordings speak against, asked again where those recordings stay within the motion of training.
//
// Why        a motion that keeps to a few degrees cannot tell a spring from a cable; on one that goes through a turn
//            the wrong one of them predicts nonsense. That says nothing against what was found, and much against the
//            motion it was found on
// Rule       a twentieth of the rows lie beyond, and on the others (motion_range.hpp) the names pass the test that they
//            fail on all of them (unseen_refutation.hpp); where fewer than 100 are within, nothing speaks against them
//            there
// Not asked  where the training recording says itself that the names are a part of something else
// Threads    spreads twins over `threads`; same bits for any number

#include <optional>
#include <span>

#include "engine/pipeline/motion_range.hpp"
#include "engine/pipeline/recording_checks.hpp"
#include "engine/unseen/unseen_record.hpp"

namespace torquescope {

// where the names' training motion kept to, when only what is beyond speaks against them
std::optional<MotionRange> spoils_only_beyond(StageSetting const& setting, std::span<Recording const> unseen,
                                              Selection const& selection);

// the verdict then; joint: with the names and the relative errors of the unseen recordings
Hopeless too_narrow(JointDiagnosis const& joint, MotionRange const& trained);

}  // namespace torquescope
