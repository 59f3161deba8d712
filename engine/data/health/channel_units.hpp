#pragma once
// Units that a column's name tells and the job does not: degrees, counts, per mille. Other joints that move in the
// file.
//
// Fault      a name that says another unit than SI where the job has no factor; whole numbers that can only be counts
// Warning    a current or voltage taken for a torque; a position that the file's names call a command
// Threads    free functions

#include "engine/data/health/examination.hpp"

namespace torquescope {

void examine_units(Examination& exam);

// "mA" of a torque column of another quantity whose factor nobody knows: no torque_per_unit, or 1 or -1; else ""
std::string unit_of_unknown_torque(Examination const& exam);

// columns of the table that are called as the position but for their number, and move
std::vector<std::size_t> other_joint_columns(Examination& exam);
void find_other_joints(Examination& exam);

}  // namespace torquescope
