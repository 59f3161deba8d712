#pragma once
// How much of a concealed effect a recording shows, in numbers that do not depend on any diagnosis.
//
// Size       residual of the baseline fitted to the run without noise (baseline_fit.hpp), low-passed like the job's
//            torque, against the low-passed torque noise (reading minus model torque: current noise, converter,
//            disturbance, friction wander). Clean runs have residual zero, so no artefact is subtracted
// Units      shares are of the low-passed torque's rms

#include <vector>

#include "concealed/baseline_fit.hpp"
#include "concealed/case_list.hpp"

namespace concealed {

struct EffectSize {
  double residual_rms = 0.0;  // after the baseline fit, without noise
  double noise_rms = 0.0;
  double torque_rms = 0.0;
  double snr() const { return residual_rms / noise_rms; }
  double torque_share() const { return residual_rms / torque_rms; }
};

// of the effects together; `quiet` is the run without noise, `noisy` the recording
EffectSize effect_size(LoopRun const& quiet, LoopRun const& noisy, Baseline const& fitted, Rig const& rig);

// torque the reading has in excess of the true model torque, one value per tick
std::vector<double> torque_noise(Rig const& rig, LoopRun const& noisy);

double rms(std::vector<double> const& values);
// low-passed like the job's torque
double in_band_rms(std::vector<double> const& values);

}  // namespace concealed
