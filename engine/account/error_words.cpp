#include "engine/account/error_words.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "engine/base/quantity_text.hpp"
#include "engine/effects/effect_traits.hpp"

namespace torquescope {
namespace {

// of an error in training and validation, by the same model
bool is_other_kind(double validation, double train) {
  constexpr double times = 3.0, points = 0.03;
  return validation > times * train && validation > train + points;
}

constexpr double usual_p = 0.05;

std::string omnibus_text(JointDiagnosis const& joint) {
  return p_text(joint.omnibus_p, 1.0 / static_cast<double>(joint.replicates + 1));
}

// of those without a name the candidate that is least by chance; null where all have one
Candidate const* surest_refused(JointDiagnosis const& joint) {
  Candidate const* surest = nullptr;
  for (auto const& one : joint.candidates)
    if (one.decision == Decision::rejected && (!surest || one.q < surest->q)) surest = &one;
  return surest;
}

}  // namespace

std::string gain_sentence(JointDiagnosis const& joint) {
  bool const validation = std::isfinite(joint.validation_relerr) && std::isfinite(joint.augmented_validation_relerr);
  double const before = validation ? joint.validation_relerr : joint.cv_relerr;
  double const after = validation ? joint.augmented_validation_relerr : joint.augmented_cv_relerr;
  if (!std::isfinite(before) || !std::isfinite(after)) return "";
  return fmt::format("{} error {} to {}.", validation ? "Validation" : "Cross-validated", percent_text(before),
                     percent_text(after));
}

std::string validation_is_other_sentence(JointDiagnosis const& joint) {
  if (!std::isfinite(joint.validation_relerr) || !is_other_kind(joint.validation_relerr, joint.train_relerr)) return "";
  double validation = joint.validation_relerr, train = joint.train_relerr;
  if (std::isfinite(joint.augmented_validation_relerr)) {
    validation = joint.augmented_validation_relerr;
    train = joint.augmented_train_relerr;
    if (!is_other_kind(validation, train)) return "";
  }
  return fmt::format(
      "The validation recording holds something that the training recording does not show, or its motion asks for "
      "numbers that training does not determine: error {} there, {} here.",
      percent_text(validation), percent_text(train));
}

std::string way_out_of_a_fault(JointDiagnosis const& joint, bool is_complete) {
  std::string const mend = std::any_of(joint.effects.begin(), joint.effects.end(), comes_before_motion)
                               ? "correct the channel, or record the torque that the drive gives instead of its command"
                               : "correct the channel, or record again";
  if (!is_complete) return mend + "; what else is missing shows then";
  return validation_is_other_sentence(joint).empty() ? mend + "; the model itself needs nothing more" : mend;
}

bool is_unlike_replicates(JointDiagnosis const& joint) { return joint.omnibus_p < usual_p; }

std::string likeness_sentence(JointDiagnosis const& joint) {
  if (joint.replicates == 0) return fmt::format("Nothing is missing in the model of {}.", which_joint(joint));
  std::string const p = omnibus_text(joint);
  if (!is_unlike_replicates(joint))
    return fmt::format("The residual of {} looks like that of {} simulated replicates ({}).", which_joint(joint),
                       joint.replicates, p);
  return fmt::format(
      "The residual of {} differs from that of {} simulated replicates ({}), but by too little for a name.",
      which_joint(joint), joint.replicates, p);
}

std::string unlikeness_sentence(JointDiagnosis const& joint, std::string const& nothing_fits) {
  Candidate const* refused = surest_refused(joint);
  bool const is_for_one = !is_unlike_replicates(joint) && refused && refused->q < usual_p;
  if (!is_for_one)
    return fmt::format("The residual of {} is not what simulated replicates have ({}), but {}.", which_joint(joint),
                       omnibus_text(joint), nothing_fits);
  return fmt::format(
      "The residual of {} is no larger than that of simulated replicates ({}), but {} explains more of it than of "
      "theirs "
      "(beyond chance). It gets no name: {}.",
      which_joint(joint), omnibus_text(joint), refused->name, refused->reason);
}

std::string timing_sentence(double late_s, double rate_hz) {
  if (late_s == 0.0) return "";
  bool const is_late = late_s > 0.0;
  return fmt::format(
      "The torque comes {:.2g} ms {} its rows, {:.2g} of a sample, as it does where drive and log are not in step. "
      "It was shifted back; {} recording.delay_s by as much to keep that. Only where drive and log are read together "
      "is it a lag.",
      1e3 * std::abs(late_s), is_late ? "after" : "before", std::abs(late_s) * rate_hz, is_late ? "lower" : "raise");
}

}  // namespace torquescope
