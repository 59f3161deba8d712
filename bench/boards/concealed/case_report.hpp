#pragma once
// Runs a case and gathers what its truth file says.
//
// Runs       training and validation motion, each with and without noise; the training motion once more with half the
//            step
// Accuracy   step_error: half step against full step, rms, as share of the torque noise and of the encoder's rounding;
//            all noises in the loop, but an exact encoder: a reading that rounds the other way because of the last bit
//            is the loop's sensitivity, not the integrator's error
// Threads    free functions

#include "concealed/case_list.hpp"
#include "concealed/effect_size.hpp"
#include "concealed/truth_region.hpp"

namespace concealed {

inline constexpr double largest_step_error = 0.01;  // a coarser plant is no truth; judge.py says the same

struct StepError {
  double torque = 0.0;    // of the rms of the torque noise
  double position = 0.0;  // of the rms of the encoder's rounding
  bool is_exact() const { return torque <= largest_step_error && position <= largest_step_error; }
};

// relative errors of the low-passed torque at the true motion: the baseline fitted without noise, and the true model;
// and the true model at the motion as recorded (recorded_motion.hpp), away from reversals
struct Relerr {
  double baseline = 0.0, oracle = 0.0, oracle_of_recording = 0.0;
};

struct CaseReport {
  Recording train, validate;
  BaselineFit fit;  // of the training run without noise
  EffectSize together;
  std::vector<EffectSize> alone;  // of each effect with the others absent
  std::vector<std::vector<TruthRegion>> regions;
  Relerr train_relerr, validate_relerr;
  StepError step_error;
};

CaseReport report_case(Case const& one_case);

StepError step_error(Case const& one_case, LoopRun const& noisy_training);

}  // namespace concealed
