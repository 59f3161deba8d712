#include "engine/diagnose/beside_shared_arm.hpp"

#include <cmath>
#include <utility>
#include <vector>

#include "engine/account/sentences.hpp"
#include "engine/fit/statistics/held_out_gain.hpp"

namespace torquescope {
namespace {

// one of them is none where a model drops a row
void add_known(std::vector<double>& values, Eigen::VectorXd const& from, Eigen::VectorXd const& beside) {
  for (Eigen::Index i = 0; i < from.size(); ++i)
    if (std::isfinite(from[i]) && std::isfinite(beside[i])) values.push_back(from[i]);
}

HeldOutChange change_of(JointDiagnosis const& alone, JointDiagnosis const& refitted, Eigen::Index memory) {
  if (alone.traces.size() != refitted.traces.size()) return HeldOutChange::undecided;
  std::vector<HeldOutBlock> blocks;
  for (std::size_t r = 0; r < alone.traces.size(); ++r) {
    Eigen::VectorXd const &before = alone.traces[r].before, &after = refitted.traces[r].after;
    if (before.size() != after.size()) return HeldOutChange::undecided;
    std::vector<double> left_before, left_after;
    add_known(left_before, before, after);
    add_known(left_after, after, before);
    auto const n = static_cast<Eigen::Index>(left_before.size());
    auto const own = held_out_blocks(Eigen::Map<Eigen::VectorXd const>(left_before.data(), n),
                                     Eigen::Map<Eigen::VectorXd const>(left_after.data(), n), memory);
    blocks.insert(blocks.end(), own.begin(), own.end());
  }
  return held_out_gain(blocks).change;
}

bool stands(JointDiagnosis const& alone, JointDiagnosis const& refitted, DecisionLevels const& levels,
            Eigen::Index memory) {
  if (refitted.effects.empty()) return false;
  double const least = 1.0 - levels.least_fall;
  if (!std::isfinite(alone.validation_relerr)) return refitted.augmented_cv_relerr < least * alone.cv_relerr;
  return refitted.augmented_validation_relerr < least * alone.validation_relerr &&
         change_of(alone, refitted, memory) == HeldOutChange::lower;
}

}  // namespace

JointOutcome beside_shared_arm(JointOutcome const& alone, JointOutcome refitted, DecisionLevels const& levels,
                               Eigen::Index memory) {
  JointDiagnosis const& before = alone.diagnosis.joints.front();
  JointDiagnosis& joint = refitted.diagnosis.joints.front();
  if (!stands(before, joint, levels, memory)) return alone;
  joint.train_relerr = before.train_relerr;
  joint.validation_relerr = before.validation_relerr;
  joint.cv_relerr = before.cv_relerr;
  joint.train_left_out.energy = before.train_left_out.energy;
  joint.train_left_out.relerr = before.train_left_out.relerr;
  joint.validation_left_out.energy = before.validation_left_out.energy;
  joint.validation_left_out.relerr = before.validation_left_out.relerr;
  for (std::size_t r = 0; r < joint.traces.size() && r < before.traces.size(); ++r)
    if (joint.traces[r].before.size() == before.traces[r].before.size())
      joint.traces[r].before = before.traces[r].before;
  refitted.diagnosis.reason = whole_reason(refitted.diagnosis);
  return refitted;
}

}  // namespace torquescope
