#pragma once
// What several joints of an arm feel at once: asked of the rows of all joints as their models treat them, and taken
// out of the recordings before joints are asked for effects of their own.
//
// Errors     those of the filters
// Threads    spreads effects over the input's threads; same bits for any number

#include <optional>
#include <vector>

#include "engine/diagnose/arm_diagnosis.hpp"
#include "engine/diagnose/arms/filtered_arm.hpp"
#include "engine/diagnose/arms/whole_arm_search.hpp"

namespace torquescope {

// those of training first
struct ArmFiles {
  std::vector<RecordedArm> arms{};
  std::size_t training = 0;
  std::vector<Effect const*> wanted{};  // effects of the whole arm that the job asks for
  Eigen::VectorXd parameters{};         // [R] of the arm whose zeros, links and joints these effects change

  std::vector<std::string> names(bool of_training) const;
  std::vector<double> begins_s(std::size_t joint) const;
};
ArmFiles arm_files(ArmDiagnosisInput const& input, std::vector<RecordedArm> arms, ArmFilter const& filter);

// joints with the columns of the arm, of their neighbours and of effects of the whole arm
struct JointsOfArm {
  std::vector<std::vector<Recording>> files{};  // [file][N]
  std::vector<EffectPlace> effects{};           // empty: none is asked for
};
JointsOfArm joints_of(ArmFiles const& files, ArmModel const& model, ArmFilter const& filter, int threads);

// rows: of each joint, none where it has no model; noise: [N]
struct RowsOfArm {
  std::vector<EffectPlace> const& effects;
  std::vector<std::optional<ArmRowsOfJoint>> const& rows;
  Eigen::VectorXd noise{};
};
WholeArmAnswer effects_of_whole_arm(ArmDiagnosisInput const& input, RowsOfArm const& of);

// what the effects add is no torque to explain any more; it passes the gears all the same. The effects are those of
// `files`
std::vector<RecordedArm> without_effects(ArmDiagnosisInput const& input, ArmFiles const& files, ArmFilter const& filter,
                                         std::vector<FoundWholeArmEffect> const& accepted);

}  // namespace torquescope
