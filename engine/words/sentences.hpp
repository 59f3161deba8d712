#pragma once
// What a diagnosis says to a person: what is missing, where, how much, how sure, what naming it buys.
//
// Wording    follows what kind of thing an effect is (where it acts, parity, units, axis of its region), not its name; an
//            effect that the catalogue does not know is worded by what the record says of it
// Never      "significant", "likely", a p-value of more than two digits or of zero (UX.md section 3)
// Signs      ASCII minus
// Threads    pure functions
// Source     UX.md section 3, verdict table

#include <string>
#include <vector>

#include "engine/pipeline/motion_range.hpp"
#include "engine/verdict/diagnosis.hpp"

namespace torquescope {

// "Joint 1 loses 0.35 N m extra below 0.12 rad/s in both directions: Stribeck friction (p < 0.005; presliding cannot be
// excluded)."
std::string effect_sentence(JointDiagnosis const& joint, NamedEffect const& effect);

// of names that are to be withdrawn because of unseen recordings: "backlash, which would explain it, takes the unseen relerr from
// 2.2 % to 2.5 %, where twins with it promise 1.6 %", or "and a joint simulated with it no longer follows the reference"
std::string refutation_clause(JointDiagnosis const& joint, bool twins_ran_away);
// because unseen recordings go beyond the training motion: "the training motion keeps to positions between -0.05 and 0.05 rad and
// speeds between -0.3 and 0.3 rad/s, and spring explains what is missing there; where unseen recordings go beyond, it takes their
// relerr from 1.5 % to 3.2 %: so narrow a motion cannot tell a law"
std::string beyond_training_clause(JointDiagnosis const& joint, MotionRange const& trained);
// because of what they leave: "backlash, the closest of 29 known effects, explains 37 % of what is missing". Share: 0 to 1
std::string too_little_clause(JointDiagnosis const& joint, double share);

// of the whole verdict: the effects' sentences and what naming them brings (error_words.hpp); what is left when nothing is
// named; what to do when the recording cannot tell; whether the unseen recording is of another kind
std::string reason_sentence(Diagnosis const& diagnosis);

// "below 0.12 rad/s in both directions", "around 12 waves per turn"; "" for an interval without axis
std::string place_phrase(JointDiagnosis const& joint, AxisInterval const& interval);
// of one or two of the same axis: "above 0.40 rad/s in both directions"; "" for none
std::string place_phrase(JointDiagnosis const& joint, std::vector<AxisInterval> const& intervals);

}  // namespace torquescope
