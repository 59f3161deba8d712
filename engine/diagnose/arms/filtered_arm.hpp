#pragma once
// A recording of an arm through the job's filters: the motion of its joints, and their rows in the fit.
//
// Shapes     one Motion a joint, n samples at the full rate; rows as make_recorded_rows()
// Units      SI
// Errors     those of the filters
// Threads    free functions

#include <vector>

#include "engine/data/motion.hpp"
#include "engine/fit/problem/arm_model.hpp"
#include "engine/fit/problem/recorded_arm.hpp"
#include "engine/fit/problem/recorded_rows.hpp"

namespace torquescope {

// what all recordings share; outlives what is made with it
struct ArmFilter {
  FilterOptions const& options;
  Section const& section;
};

std::vector<Motion> motion_of(RecordedArm const& recording, ArmFilter const& filter);

RecordedRows rows_of(ArmModel const& model, RecordedArm const& recording, std::vector<Motion> const& motion,
                     ArmFilter const& filter);

}  // namespace torquescope
