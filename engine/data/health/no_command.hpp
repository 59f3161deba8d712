#pragma once
// A reference column that is no command: a constant of another mode of the drive, or the position some rows away.
//
// Constant   far outside the motion (a stop code); or inside, and the joint goes on moving to the end as before, which
//            a loop with a constant command does not, unless the job names what else drives it (added_command,
//            external_torque)
// Copy       the position of a later row, as data sets for imitation call it an action, or of an earlier one: nearly
//            all rows that move agree to single precision, and no joint follows so well (the position of the same row:
//            pipeline/echoed_reference.hpp)
// Then       the column is not used; of a recording without a torque it stays, for there is nothing else
// Threads    free functions

#include "engine/data/health/examination.hpp"

namespace torquescope {

void examine_constant_reference(Examination& exam);  // before registers are decoded: a stop code looks like one
// One value far beyond all others: in most rows the column is not used, in fewer these values are missing
void take_out_stop_codes(Examination& exam);
void examine_copied_reference(Examination& exam);  // with reference and position in one unit

}  // namespace torquescope
