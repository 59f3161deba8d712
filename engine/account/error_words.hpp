#pragma once
// What the errors of a diagnosis say, as sentences: what naming brings, whether validation is of another kind, and
// whether the residual is like that of replicates.
//
// Unknown    a sentence whose numbers were not measured is ""
// Wording    as sentences.hpp
// Threads    pure functions

#include <string>

#include "engine/infer/verdict/diagnosis.hpp"

namespace torquescope {

// "Validation error 12.1 % to 6.2 %."; from cross-validation where no validation was recorded
std::string gain_sentence(JointDiagnosis const& joint);

// A validation error beyond three times and three points above the error in training, before and after: "The
// validation recording holds something that the training recording does not show, or its motion asks for numbers that
// training does not determine: error 18.4 % there, 0.82 % here."; "" otherwise
std::string validation_is_other_sentence(JointDiagnosis const& joint);

// where nothing is named but a fault of the recording: a clause. The model is called complete only where the validation
// recording agrees, and where nothing else is left (is_complete)
std::string way_out_of_a_fault(JointDiagnosis const& joint, bool is_complete);

// Of a joint with a closed gate. Where p is small, what kept it closed is said: a mismatch below what matters, or one
// that is within the replicates' spread while no effect stands out
std::string likeness_sentence(JointDiagnosis const& joint);

// whether fewer than 5 % of replicates leave as much as the recording
bool is_unlike_replicates(JointDiagnosis const& joint);

// Of a joint with an open gate whose map shows nothing: what it is that replicates do not have, the whole or what one
// candidate would make. nothing_fits: a clause
std::string unlikeness_sentence(JointDiagnosis const& joint, std::string const& nothing_fits);

// of a torque that was moved in time by less than a name; "" where it was not
std::string timing_sentence(double late_s, double rate_hz);

}  // namespace torquescope
