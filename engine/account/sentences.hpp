#pragma once
// What a diagnosis says to a person: what is missing, where, how much, how sure, what naming it buys.
//
// Wording    follows what kind of thing an effect is (where it acts, parity, units, axis of its region), not its name;
//            an effect that the catalogue does not know is worded by what the record says of it
// Never      "significant", "likely", a p-value of more than two digits or of zero
// Signs      ASCII minus
// Threads    pure functions

#include <string>
#include <vector>

#include "engine/infer/verdict/diagnosis.hpp"

namespace torquescope {

// "Joint 1 loses 0.35 N m extra below 0.12 rad/s in both directions: Stribeck friction (p < 0.005; presliding cannot be
// excluded)."
std::string effect_sentence(JointDiagnosis const& joint, NamedEffect const& effect);

// of the whole verdict: the effects' sentences and what naming them brings (error_words.hpp); what is left when nothing
// is named; what to do when the recording cannot tell; whether the validation recording is of another kind
std::string reason_sentence(Diagnosis const& diagnosis);

// the same with what the motion closed or merged
std::string whole_reason(Diagnosis const& diagnosis);

// "below 0.12 rad/s in both directions", "around 12 waves per turn"; "" for an interval without axis
std::string place_phrase(JointDiagnosis const& joint, AxisInterval const& interval);
// of one or two of the same axis: "above 0.40 rad/s in both directions"; "" for none
std::string place_phrase(JointDiagnosis const& joint, std::vector<AxisInterval> const& intervals);

}  // namespace torquescope
