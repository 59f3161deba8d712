#pragma once
// The baseline model fitted to the truth of a run: what an identification with perfect signals would arrive at.
//
// Rows       ticks during which the joint moves in one direction (Truth::moves); torque held by the motor against the
//            exact motion at the middle of the tick. Without hidden effects and disturbance the residual is zero to
//            rounding: what is left with an effect is what the baseline cannot absorb, and no artefact of filters has
//            to be subtracted
// Direction  a motion in one direction only leaves the Coulomb level at 0: the offset takes it
// Shapes     residual: one value per tick, 0 where the tick is no row

#include <vector>

#include "concealed/closed_loop.hpp"

namespace concealed {

struct BaselineFit {
  Baseline parameters;
  std::vector<double> residual;
};

BaselineFit fit_baseline(Truth const& truth, bool with_gravity);

// torque the motor holds minus what the fitted baseline asks for; 0 where the tick is no row
std::vector<double> baseline_residual(Truth const& truth, Baseline const& fitted);

}  // namespace concealed
