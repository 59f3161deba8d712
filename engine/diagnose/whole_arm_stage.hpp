#pragma once
// What several joints of an arm feel at once: asked of the rows of all joints as their models treat them, and taken
// out of the recordings before joints are asked for effects of their own.
//
// Errors     those of the filters
// Threads    spreads laws over the input's threads; same bits for any number

#include <optional>
#include <vector>

#include "engine/diagnose/arm_diagnosis.hpp"
#include "engine/diagnose/arms/filtered_arm.hpp"
#include "engine/diagnose/arms/whole_arm_search.hpp"

namespace torquescope {

// those of training first; laws: of the whole arm as far as the job asks for them, of each file
struct ArmFiles {
  std::vector<RecordedArm> arms{};
  std::size_t training = 0;
  std::vector<std::vector<WholeArmLaw>> laws{};

  std::vector<std::string> names(bool of_training) const;
  std::vector<double> begins_s(std::size_t joint) const;
  Eigen::Index law_columns() const;  // 0: none is asked for
};
ArmFiles arm_files(ArmDiagnosisInput const& input, std::vector<RecordedArm> arms, ArmFilter const& filter);

// [file][N]: joints with the columns of the arm, of their neighbours and of laws of the whole arm
std::vector<std::vector<Recording>> joints_of(ArmFiles const& files, ArmModel const& model, ArmFilter const& filter);

// rows: of each joint, none where it has no model; noise: [N]
WholeArmAnswer laws_of_whole_arm(ArmDiagnosisInput const& input, ArmFiles const& files,
                                 std::vector<std::optional<ArmRowsOfJoint>> const& rows, Eigen::VectorXd const& noise,
                                 DecisionNumbers numbers);

// what the laws add is no torque to explain any more; it passes the gears all the same. The laws are those of `files`
std::vector<RecordedArm> without_laws(ArmFiles const& files, std::vector<FoundWholeArmLaw> const& accepted);

}  // namespace torquescope
