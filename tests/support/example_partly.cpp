// The invented joint where two effects explain a part, and something along its position is left.

#include "engine/account/sentences.hpp"
#include "support/example_diagnosis.hpp"

namespace torquescope::example {

Diagnosis invented_partly() {
  Diagnosis diagnosis = invented_diagnosis();
  diagnosis.verdict = Verdict::partly;
  JointDiagnosis& joint = diagnosis.joints[0];
  joint.augmented_train_relerr = 0.0764;
  joint.augmented_validation_relerr = 0.0783;
  joint.augmented_cv_relerr = 0.0771;
  joint.explained_share = 0.71;
  joint.budget = {0.03, 0.44, 0.28, 0.25};
  joint.unexplained = {{{"position", 0.4, 0.9, "rad"}, 0.21}, {{"load", 0.95, 1.29, "N m"}, 0.09}};
  joint.left_rms = 0.041;
  for (auto& axis : joint.map)
    for (auto& cell : axis.cells)
      if (axis.axis == "position" && cell.from >= 0.4) {
        cell.after_residual += 0.08;
        cell.after_z += 0.08 / cell.replicate_std;
      }
  diagnosis.reason = reason_sentence(diagnosis);
  return diagnosis;
}

}  // namespace torquescope::example
