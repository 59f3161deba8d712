#include "engine/diagnose/arms/filtered_arm.hpp"

#include "engine/data/filter_checks.hpp"
#include "engine/infer/pipeline/arm_reversals.hpp"

namespace torquescope {

std::vector<Motion> motion_of(RecordedArm const& recording, ArmFilter const& filter) {
  std::vector<Motion> motion;
  for (auto const& joint : recording.joints) motion.push_back(differentiate(joint, filter.options, filter.section));
  return motion;
}

RecordedRows rows_of(ArmModel const& model, RecordedArm const& recording, std::vector<Motion> const& motion,
                     ArmFilter const& filter) {
  auto const moves = samples_one_way(model, motion, parallel_cutoff_of(filter.options));
  return make_recorded_rows(recording.joints.front().name, motion, moves, filter.options, model, filter.section,
                            recording.payload);
}

}  // namespace torquescope
