#include "concealed/effect_size.hpp"

#include <cmath>

#include "concealed/low_pass.hpp"

namespace concealed {
double rms(std::vector<double> const& values) {
  double sum = 0.0;
  for (double value : values) sum += value * value;
  return std::sqrt(sum / static_cast<double>(values.size()));
}

double in_band_rms(std::vector<double> const& values) {
  return rms(low_passed(values, parallel_cutoff_hz, 1.0 / tick_s));
}

std::vector<double> torque_noise(Rig const& rig, LoopRun const& noisy) {
  Truth const& truth = noisy.truth;
  std::vector<double> noise = noisy.recording.torque;
  for (std::size_t k = 0; k < noise.size(); ++k) {
    noise[k] -= truth.seen_motor[k] + truth.disturbance[k];
    // the wander of the friction level is nothing a model of the joint could know
    if (truth.moves[k]) {
      double const wander = (truth.coulomb_factor[k] - 1.0) * rig.joint.baseline.coulomb;
      noise[k] += truth.v[k] > 0.0 ? wander : -wander;
    }
  }
  return noise;
}

EffectSize effect_size(LoopRun const& quiet, LoopRun const& noisy, Baseline const& fitted, Rig const& rig) {
  return {in_band_rms(baseline_residual(quiet.truth, fitted)), in_band_rms(torque_noise(rig, noisy)),
          in_band_rms(noisy.recording.torque)};
}

}  // namespace concealed
