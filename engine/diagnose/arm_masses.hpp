#pragma once
// What the rows of each joint tell of the arm's masses, beside a model of its own in which all of them are free.
//
// Nothing    is told by a joint whose rows suit no model: it leaves the masses to the others
// Threads    pure functions

#include <optional>
#include <vector>

#include "engine/diagnose/whole_arm_stage.hpp"

namespace torquescope {

// columns that joint j shares, in the place of its own term of that name
SharedEffect shared_masses(ArmModel const& model, std::size_t joint, char const* instead_of);

// the joints of an arm before anything is known of what they lack
struct LearntArm {
  ArmFiles files{};
  std::vector<EffectPlace> effects{};                 // of the whole arm, in the recordings
  std::vector<std::vector<Recording>> recordings{};   // [N][file], with their columns
  std::vector<SharedInformation> information{};       // [N]
  std::vector<double> variances{};                    // [N]
  std::vector<std::optional<ArmRowsOfJoint>> rows{};  // [N] where effects of the whole arm are asked for

  Eigen::VectorXd noise() const;  // [N]
};
// arms: those of training first
LearntArm learnt_arm(ArmDiagnosisInput const& input, std::vector<RecordedArm> arms, ArmFilter const& filter);

// of a decided joint; none where no effect of the whole arm is asked for
std::optional<ArmRowsOfJoint> rows_for_whole_arm(LearntArm const& arm, JointStrips const& strips,
                                                 FittedModel const& model, SharedEffect const& effect,
                                                 std::size_t joint);

}  // namespace torquescope
