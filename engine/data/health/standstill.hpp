#pragma once
// A recording of a joint that does not move: its position shows an encoder's steps and noise, and no motion.
//
// Equation   range of the position below thirty standard deviations of its white noise, or below twenty encoder steps:
//            the range of noise alone over 1e6 samples is ten standard deviations
// Threads    free function

#include "engine/data/health/examination.hpp"

namespace torquescope {

void find_standstill(Examination& exam);

// less than twenty encoder steps in all, or so many different values: such rows tell steps, and no motion that one of
// them could break
bool covers_few_steps(std::vector<double> const& position);

}  // namespace torquescope
