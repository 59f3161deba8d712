#include "engine/account/withdrawn_names.hpp"

#include <fmt/format.h>

#include <cmath>

#include "engine/account/name_list.hpp"
#include "engine/base/quantity_text.hpp"

namespace torquescope {

std::string too_little_clause(JointDiagnosis const& joint, double share) {
  return fmt::format("{}, the closest of {} known effects, {} {} of what is missing", name_list(names_of(joint), "and"),
                     n_tested(joint), joint.effects.size() == 1 ? "explains" : "explain", percent_text(share));
}

namespace {

bool raise_all_samples(LeftOut const& all) { return all.time > 0.0 && all.augmented_relerr > all.relerr; }

// "the validation error from 2.2 % to 2.5 %"; of all samples where that is what speaks against the names
std::string before_and_after(JointDiagnosis const& joint) {
  LeftOut const& all = joint.validation_left_out;
  if (raise_all_samples(all))
    return fmt::format("the validation error of all samples from {} to {}", percent_text(all.relerr),
                       percent_text(all.augmented_relerr));
  bool const is_unseen = std::isfinite(joint.validation_relerr);
  return fmt::format("the {} error from {} to {}", is_unseen ? "validation" : "cross-validated",
                     percent_text(is_unseen ? joint.validation_relerr : joint.cv_relerr),
                     percent_text(is_unseen ? joint.augmented_validation_relerr : joint.augmented_cv_relerr));
}

}  // namespace

std::string too_small_clause(JointDiagnosis const& joint) {
  auto const names = names_of(joint);
  return fmt::format("{} {} {}: too little to be a finding", name_list(names, "and"),
                     names.size() == 1 ? "takes" : "take", before_and_after(joint));
}

std::string other_joints_sentence(JointDiagnosis const& joint, std::vector<std::string> const& columns, double relerr) {
  return fmt::format(
      "What is missing at {} goes with the motion of {}, which {} the cross-validated error from {} to {}, further "
      "than any effect at this joint: other joints load it. Diagnose the arm as a whole (model.robot = \"ARM.toml\" or "
      "its URDF).",
      which_joint(joint), fmt::join(columns, " and "), columns.size() == 1 ? "takes" : "take",
      percent_text(joint.cv_relerr), percent_text(relerr));
}

std::string refutation_clause(JointDiagnosis const& joint, bool twins_ran_away) {
  auto const names = names_of(joint);
  bool const is_one = names.size() == 1;
  std::string text = fmt::format("{}, which would explain it, {} {}", name_list(names, "and"),
                                 is_one ? "takes" : "take", before_and_after(joint));
  if (!std::isfinite(joint.validation_relerr) || raise_all_samples(joint.validation_left_out)) return text;
  std::string const with = is_one ? "it" : "them";
  if (twins_ran_away)
    return text + fmt::format(", and a joint simulated with {} no longer follows the reference", with);
  if (!std::isfinite(joint.floor_relerr)) return text;
  return text + fmt::format(", where replicates with {} promise {}", with, percent_text(joint.floor_relerr));
}

}  // namespace torquescope
