#include "concealed/case_report.hpp"

#include <cmath>

#include "concealed/low_pass.hpp"
#include "concealed/recorded_motion.hpp"
#include "concealed/sensors.hpp"

namespace concealed {
namespace {

std::vector<double> difference(std::vector<double> a, std::vector<double> const& b) {
  for (std::size_t k = 0; k < a.size(); ++k) a[k] -= b[k];
  return a;
}

// The true laws along the recorded motion: where that differs from the true one, inertia and viscous friction of the
// rig are asked for another torque
double oracle_of_recording(Rig const& rig, LoopRun const& noisy) {
  RecordedMotion const recorded = recorded_motion(noisy.recording);
  Truth const& truth = noisy.truth;
  std::vector<char> const counts = far_from_reversals(truth, parallel_cutoff_hz);
  Baseline const& joint = rig.joint.baseline;
  std::vector<double> left(truth.t.size());
  for (std::size_t k = 0; k < left.size(); ++k)
    left[k] = noisy.recording.torque[k] - truth.seen_motor[k] - joint.inertia * (recorded.a[k] - truth.seen_a[k]) -
              joint.viscous * (recorded.v[k] - truth.seen_v[k]);
  auto const filtered_left = low_passed(left, parallel_cutoff_hz, 1.0 / tick_s);
  auto const filtered_torque = low_passed(noisy.recording.torque, parallel_cutoff_hz, 1.0 / tick_s);
  double error = 0.0, whole = 0.0;
  for (std::size_t k = 0; k < left.size(); ++k) {
    if (!counts[k]) continue;
    error += filtered_left[k] * filtered_left[k];
    whole += filtered_torque[k] * filtered_torque[k];
  }
  return whole > 0.0 ? std::sqrt(error / whole) : 0.0;
}

Relerr relerr(Rig const& rig, LoopRun const& noisy, Baseline const& fitted) {
  auto const noise = torque_noise(rig, noisy);
  std::vector<double> from_baseline = baseline_residual(noisy.truth, fitted), from_truth(noise.size(), 0.0);
  std::vector<double> torque(noise.size(), 0.0);
  for (std::size_t k = 0; k < noise.size(); ++k) {
    if (!noisy.truth.moves[k]) continue;
    from_baseline[k] += noisy.recording.torque[k] - noisy.truth.seen_motor[k];
    from_truth[k] = noise[k];
    torque[k] = noisy.recording.torque[k];
  }
  double const whole = in_band_rms(torque);
  return {in_band_rms(from_baseline) / whole, in_band_rms(from_truth) / whole, oracle_of_recording(rig, noisy)};
}

// where each effect's torque stands in Truth::added: laws first, then the rig's own instruments, then concealed faults
std::vector<std::size_t> places_in_truth(Case const& one_case) {
  std::size_t law = 0, fault = one_case.laws().size() + one_case.rig.instruments.size();
  std::vector<std::size_t> places;
  for (auto const& effect : one_case.effects) places.push_back(effect.law ? law++ : fault++);
  return places;
}

}  // namespace

StepError step_error(Case const& one_case, LoopRun const& noisy_training) {
  Rig smooth = one_case.rig;
  smooth.encoder_bits = 0;
  LoopRun const coarse = training_run(one_case, smooth, one_case.effects, default_step_s);
  LoopRun const fine = training_run(one_case, smooth, one_case.effects, 0.5 * default_step_s);
  double const rounding =
      Encoder::per_turn(one_case.rig.encoder_bits, one_case.rig.joint.travel_per_turn).step() / std::sqrt(12.0);
  return {rms(difference(coarse.truth.motor, fine.truth.motor)) / rms(torque_noise(one_case.rig, noisy_training)),
          rms(difference(coarse.truth.q, fine.truth.q)) / rounding};
}

CaseReport report_case(Case const& one_case) {
  Rig const& rig = one_case.rig;
  Rig const quiet_rig = without_noise(rig);
  bool const with_gravity = rig.joint.baseline.has_gravity();

  LoopRun const noisy = training_run(one_case, rig, one_case.effects, default_step_s);
  LoopRun const quiet = training_run(one_case, quiet_rig, one_case.effects, default_step_s);
  Excitation const validation = one_case.excitation(false);
  LoopRun const validate =
      run_closed_loop(with_faults(rig, one_case.effects), one_case.laws(), one_case.plan(validation, false));

  auto const place = places_in_truth(one_case);
  CaseReport report;
  report.fit = fit_baseline(quiet.truth, with_gravity);
  report.together = effect_size(quiet, noisy, report.fit.parameters, rig);
  for (std::size_t i = 0; i < one_case.effects.size(); ++i) {
    report.regions.push_back(truth_regions(quiet.truth, quiet.truth.added[place[i]], rig.joint.baseline));
    if (one_case.effects.size() == 1) {
      report.alone.push_back(report.together);
      continue;
    }
    LoopRun const single = training_run(one_case, quiet_rig, {one_case.effects[i]}, default_step_s);
    report.alone.push_back(effect_size(single, noisy, fit_baseline(single.truth, with_gravity).parameters, rig));
  }
  report.train_relerr = relerr(rig, noisy, report.fit.parameters);
  report.validate_relerr = relerr(rig, validate, report.fit.parameters);
  report.step_error = step_error(one_case, noisy);
  report.train = noisy.recording;
  report.validate = validate.recording;
  return report;
}

}  // namespace concealed
