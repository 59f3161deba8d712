#include "concealed_arms/arm_case.hpp"

#include <algorithm>
#include <cmath>

namespace concealed_arms {
namespace {

// a base that leans by `tilt` towards `azimuth`: gravity as the base sees it
Gravity leaning(double tilt, double azimuth) {
  double const g = -upright[2];
  return {g * std::sin(tilt) * std::cos(azimuth), g * std::sin(tilt) * std::sin(azimuth), -g * std::cos(tilt)};
}

Plant sized(Plant plant, double size) {
  plant.law->size = size;
  if (plant.law->kind == LawKind::tilted_base) plant.gravity = leaning(size, plant.law->shape);
  return plant;
}

Eigen::VectorXd zeros_of(Plant const& plant) {
  Eigen::VectorXd zeros = Eigen::VectorXd::Zero(plant.arm.joints());
  if (plant.law && plant.law->kind == LawKind::joint_zero) zeros[plant.law->joint] = plant.law->size;
  return zeros;
}

double snr_of(Law const& law, Left const& left) {
  return law.is_of_several_joints() ? left.largest_snr() : left.snr(law.joint);
}

// The law's size that leaves the wanted SNR in the training motion: the SNR is nearly proportional to it
void find_size(ArmCase& one, ArmMotion const& motion) {
  Law& law = *one.plant.law;
  double size = 0.1 * law.largest;
  ArmCase tried = one;
  constexpr int rounds = 4;
  for (int round = 0; round < rounds; ++round) {
    tried.plant = sized(one.plant, size);
    double const snr = snr_of(law, left_of(tried, run_loop(tried.plant, motion)));
    if (std::abs(snr / one.wanted_snr - 1.0) < 0.02) break;
    size = std::clamp(size * std::min(20.0, one.wanted_snr / std::max(snr, 1e-6)), law.smallest, law.largest);
  }
  one.plant = sized(one.plant, size);
}

// what the instruments make of the torque
Eigen::MatrixXd shown_torque(ArmCase const& one, Eigen::MatrixXd const& torque) {
  if (one.kind != CaseKind::decoy) return torque;
  Decoy const& decoy = one.decoy;
  Eigen::MatrixXd shown = torque;
  if (decoy.kind == DecoyKind::scaled) shown.row(decoy.joint) *= decoy.scale;
  if (decoy.kind == DecoyKind::swapped) shown.row(decoy.joint).swap(shown.row(decoy.other));
  if (decoy.kind == DecoyKind::late)
    for (Eigen::Index row = 0; row < torque.cols(); ++row)
      shown(decoy.joint, row) = torque(decoy.joint, std::max<Eigen::Index>(0, row - decoy.rows));
  return shown;
}

Eigen::MatrixXd logged(ArmCase const& one, ArmRun const& run, std::string const& stream) {
  Eigen::MatrixXd torque = one.averaged_log ? run.averaged : run.applied;
  concealed::Random random(one.seed, "torque noise " + stream);
  for (Eigen::Index row = 0; row < torque.cols(); ++row)
    for (int j = 0; j < one.plant.arm.joints(); ++j)
      torque(j, row) += one.plant.arm.links[static_cast<std::size_t>(j)].noise * random.normal();
  return shown_torque(one, torque);
}

ArmRecording recorded(ArmCase const& one, std::string const& stream) {
  ArmRecording made;
  made.run = run_loop(one.plant, drawn_motion(one.motion, one.plant.arm, one.seed, stream));
  made.torque = logged(one, made.run, stream);
  return made;
}

// The drive of an elastic joint trembles within a tick, which one instant of its acceleration shows and a log does not:
// speed, acceleration and torque about each row in place of those at it
ArmRun about_rows(ArmRun run, int joint) {
  double const h = log_every * control_s;
  auto const n = run.q.cols();
  auto const q = run.q.row(joint);
  auto const before = q.head(n - 2), at = q.segment(1, n - 2), after = q.tail(n - 2);
  run.v.row(joint).segment(1, n - 2) = (after - before) / (2.0 * h);
  run.a.row(joint).segment(1, n - 2) = (after - 2.0 * at + before) / (h * h);
  run.applied.row(joint) = run.averaged.row(joint);
  return run;
}

}  // namespace

Left left_of(ArmCase const& one_case, ArmRun const& as_run) {
  auto const& law = one_case.plant.law;
  ArmRun const run = law && law->kind == LawKind::elastic_joint ? about_rows(as_run, law->joint) : as_run;
  return left_after_fit(one_case.plant.arm, run, shown_torque(one_case, run.applied), zeros_of(one_case.plant));
}

MadeCase make_case(ArmCase const& wanted) {
  MadeCase made{.of = wanted, .train = {}, .validate = {}, .left = {}};
  if (wanted.plant.law) find_size(made.of, drawn_motion(wanted.motion, wanted.plant.arm, wanted.seed, "train"));
  made.train = recorded(made.of, "train");
  made.validate = recorded(made.of, "unseen");
  made.left = left_of(made.of, made.train.run);
  return made;
}

}  // namespace concealed_arms
