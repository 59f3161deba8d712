#include "engine/unseen/unseen_range.hpp"

#include "engine/words/withdrawn_names.hpp"

namespace torquescope {

std::optional<MotionRange> spoils_only_beyond(StageSetting const& setting, std::span<Recording const> unseen,
                                              Selection const& selection) {
  constexpr double enough_beyond = 0.05;
  MotionRange const trained = range_of(selection.final->comparison.recording, *selection.final->pipeline);
  UnseenSum sum;
  Eigen::Index rows = 0, beyond = 0;
  for (auto const& recording : unseen) {
    UnseenResult const result = check_unseen(recording, setting, *selection.baseline, *selection.final, &trained);
    rows += result.all_rows;
    beyond += result.all_rows - result.n_rows;
    if (result.torque_energy > 0.0) sum.add(result);
  }
  if (static_cast<double>(beyond) < enough_beyond * static_cast<double>(rows)) return std::nullopt;
  if (sum.torque_energy() > 0.0 && speak_against(sum.energies())) return std::nullopt;
  return trained;
}

Hopeless too_narrow(JointDiagnosis const& joint, MotionRange const& trained) {
  return {Verdict::insufficient, beyond_training_clause(joint, trained),
          "record a motion as wide as the ones that the model is to hold for"};
}

}  // namespace torquescope
