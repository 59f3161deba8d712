#include "engine/account/all_sample_errors.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "engine/base/quantity_text.hpp"

namespace torquescope {
namespace {

bool units_differ(std::vector<JointDiagnosis> const& joints) {
  return std::any_of(joints.begin(), joints.end(),
                     [&](auto const& joint) { return joint.unit_torque != joints.front().unit_torque; });
}

}  // namespace

bool ErrorPair::is_known() const { return std::isfinite(before); }

std::string ErrorPair::text() const {
  bool const has_after = std::isfinite(after) && after != before;
  return has_after ? fmt::format("{} -> {}", percent_text(before), percent_text(after)) : percent_text(before);
}

ErrorPair training_error(JointDiagnosis const& joint) { return {joint.train_relerr, joint.augmented_train_relerr}; }

ErrorPair validation_error(JointDiagnosis const& joint) {
  return {joint.validation_relerr, joint.augmented_validation_relerr};
}

ArmError validation_error_of_arm(std::vector<JointDiagnosis> const& joints) {
  ArmError whole;
  whole.is_mean_of_joints = units_differ(joints);
  double energy = 0.0, before = 0.0, after = 0.0;
  for (auto const& joint : joints) {
    ErrorPair const error = validation_error(joint);
    double const weight = whole.is_mean_of_joints ? 1.0 : joint.validation_torque_energy;
    if (!error.is_known() || !std::isfinite(weight)) continue;
    double const now = std::isfinite(error.after) ? error.after : error.before;
    energy += weight;
    before += weight * error.before * error.before;
    after += weight * now * now;
  }
  if (!(energy > 0.0)) return whole;
  whole.before = std::sqrt(before / energy);
  whole.after = std::sqrt(after / energy);
  return whole;
}

}  // namespace torquescope
