#pragma once
// Errors of a diagnosis over all samples, of a joint and of an arm: before and after what was named.
//
// Joint      NaN where no error is known: a diagnosis that was given up early
// Arm        of the validation recordings: the root of all joints' residual energy over their torques' energy. Joints
//            that turn and joints that slide have no common energy: then the root of the mean square of their errors
// Threads    pure functions

#include <string>
#include <vector>

#include "engine/infer/verdict/diagnosis.hpp"

namespace torquescope {

struct ErrorPair {
  double before = unknown, after = unknown;  // relative to the torque; after: NaN where nothing was named

  bool is_known() const;
  std::string text() const;  // "13.1 % -> 10.4 %"
};

ErrorPair training_error(JointDiagnosis const& joint);
ErrorPair validation_error(JointDiagnosis const& joint);

struct ArmError : ErrorPair {
  bool is_mean_of_joints = false;  // units differ
};

// joints whose error is not known are left out; after: joints without a name count as before
ArmError validation_error_of_arm(std::vector<JointDiagnosis> const& joints);

}  // namespace torquescope
