#include "engine/account/withdrawn_names.hpp"

#include <fmt/format.h>

#include <cmath>

#include "engine/account/name_list.hpp"
#include "engine/base/quantity_text.hpp"

namespace torquescope {

std::string other_joints_sentence(JointDiagnosis const& joint, std::vector<std::string> const& columns, double relerr) {
  return fmt::format(
      "What is missing at {} goes with the motion of {}, which {} the cross-validated error from {} to {}, further "
      "than any effect at this joint: other joints load it. Diagnose the arm as a whole (model.robot = \"ARM.toml\" or "
      "its URDF).",
      which_joint(joint), fmt::join(columns, " and "), columns.size() == 1 ? "takes" : "take",
      percent_text(joint.cv_relerr), percent_text(relerr));
}

}  // namespace torquescope
