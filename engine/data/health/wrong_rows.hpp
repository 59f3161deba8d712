#pragma once
// Rows that do not belong to the motion: a zero or garbage between good ones, zeros before the first message, two
// publishers in one file, the zero set anew.
//
// Filled     up to five rows away from where the rows around them lead (the cell becomes missing)
// Left out   zeros in every channel before the first and after the last message
// Fault      rows of two sources in turns; jumps after which the motion goes on from elsewhere
// Requires   the position is unwrapped
// Threads    free functions

#include "engine/data/health/examination.hpp"

namespace torquescope {

void examine_position_rows(Examination& exam);
// rows of the torque far beyond all others
void examine_torque_rows(Examination& exam);

}  // namespace torquescope
