#include "engine/diagnose/model_account.hpp"

#include <cmath>

#include "engine/fit/statistics/blocked_cv.hpp"
#include "engine/infer/search/detection_power.hpp"
#include "engine/infer/search/parameter_intervals.hpp"

namespace torquescope {
namespace {

std::string source_word(LoopSource source) {
  switch (source) {
    case LoopSource::identified:
      return "identified";
    case LoopSource::approximated:
      return "approximated";
    case LoopSource::tracking:
      break;
  }
  return "tracking";
}

// with what was done to the recording and its noise
std::string remark(BaselineTwin const& twin, std::string const& timing, std::string const& unit) {
  std::string said = twin.loop.remark;
  auto const add = [&](std::string const& what) { said += (said.empty() || what.empty() ? "" : "; ") + what; };
  add(timing);
  if (twin.colour) add(colour_remark(*twin.colour, unit));
  return said;
}

// of a complete model
double floor_relerr(MismatchRows const& rows) {
  auto const& twins = rows.plain_twins.size() > 0 ? rows.plain_twins : rows.twins;
  return std::sqrt(twins.colwise().squaredNorm().mean()) / rows.torque.norm();
}

double cv_relerr(ModelStage const& stage) {
  auto const& record = stage.comparison.recording;
  Eigen::VectorXd const& torque = record.torque_itself();
  return std::sqrt(blocked_residual_energy(torque, record.columns_themselves(), guard_rows(*stage.pipeline)) /
                   record.whole_torque().squaredNorm());
}

}  // namespace

double relative_error(ProcessedRecord const& record) {
  return record.residual_itself().norm() / record.whole_torque().norm();
}

void account_for_models(Selection const& selection, std::string const& timing, JointDiagnosis& joint) {
  ModelStage const& before = *selection.baseline;
  ModelStage const& after = *selection.final;
  auto const& rows = before.comparison.rows;

  // the loop and its noise
  auto const& loop = before.twin->loop;
  joint.loop_source = source_word(loop.source);
  joint.loop_remark = remark(*before.twin, timing, joint.unit_torque);
  joint.torque_noise = loop.loop.torque_noise.std;
  joint.disturbance = before.twin->disturbance.std;
  joint.friction_wander = before.twin->friction_wander.std;

  // what the recording is among its replicates
  joint.twins = static_cast<std::size_t>(rows.n_twins());
  joint.omnibus_z = before.energy.z;
  joint.omnibus_p = before.energy.p;
  joint.mismatch_rms = before.energy.excess_rms();
  joint.mismatch_share = mismatch_share(before);
  joint.left_rms = after.energy.excess_rms();
  for (Eigen::Index t = 0; t < rows.n_twins(); ++t)
    joint.twin_energy.push_back(rows.twins.col(t).squaredNorm() / before.energy.residual);
  joint.power_sentence = power_sentence(before);

  // parameters and errors
  if (selection.final->pipeline->keeps_reversals()) joint.rows = ErrorRows::in_motion;
  joint.shape_evaluations = selection.evaluations;
  joint.baseline = estimate_parameters(before).baseline;
  joint.train_relerr = relative_error(before.comparison.recording);
  joint.augmented_train_relerr = relative_error(after.comparison.recording);
  joint.cv_relerr = cv_relerr(before);
  joint.augmented_cv_relerr = cv_relerr(after);
  joint.floor_relerr = joint.train_floor_relerr = floor_relerr(after.comparison.rows);
}

}  // namespace torquescope
