#pragma once
// A reference column against the position that follows it: degrees beside rad, turns, the other sign.
//
// Compared   position less factor * reference, both without their means: a zero elsewhere is none of its business
// Corrected  a reference in another unit, or with the other sign, than the position
// Fault      a position in a unit that people forget beside a reference in rad, where the job gives no factor
// Told       where a known factor divides the difference by five and more (levels.hpp): a loop that follows badly has
//            no known factor, and one that follows well differs by little
// Threads    free function

#include "engine/data/health/examination.hpp"

namespace torquescope {

// requires the position unwrapped
void examine_reference(Examination& exam);

}  // namespace torquescope
