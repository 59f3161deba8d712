#pragma once
// Registers of a drive that were logged without their sign: two's complement read as unsigned, or a sign in a bit of
// its own.
//
// Rule       a coding is right when the way of the signal from row to row (its total variation) is shorter decoded, and
//            steps of half of the range are gone; where some are left the job must say `encoding`
// Threads    free functions

#include "engine/data/health/examination.hpp"

namespace torquescope {

// a word of recording.encoding; every coding that a finding advises is one
bool is_encoding(std::string const& word);

// of the torque and position columns; recording.encoding decides where it is written
void decode_registers(Examination& exam);

}  // namespace torquescope
