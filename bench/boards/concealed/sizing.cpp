#include "concealed/sizing.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "concealed/effect_size.hpp"

namespace concealed {
namespace {

constexpr int most_runs = 14;
constexpr double far_behind = 0.5;  // of the range: the loop has lost its joint

bool lost(Recording const& recording, double range) {
  for (std::size_t k = 0; k < recording.position.size(); ++k) {
    if (!(std::abs(recording.reference[k] - recording.position[k]) < far_behind * range)) return true;
  }
  return false;
}

}  // namespace

Sizing::Sizing(Case const& clean) : clean_(clean) {
  clean_.effects.clear();
  LoopRun const noisy = training_run(clean_, clean_.rig, {}, sizing_step_s);
  noise_rms_ = in_band_rms(torque_noise(clean_.rig, noisy));
}

double Sizing::snr_of(ConcealedEffect const& effect) const {
  LoopRun const quiet = training_run(clean_, without_noise(clean_.rig), {effect}, sizing_step_s);
  if (lost(quiet.recording, clean_.rig.joint.limits.range)) return std::numeric_limits<double>::infinity();
  BaselineFit const fit = fit_baseline(quiet.truth, clean_.rig.joint.baseline.has_gravity());
  return in_band_rms(fit.residual) / noise_rms_;
}

SizedEffect Sizing::find(Amplifier const& amplify, double usual, double largest, double wanted_snr) const {
  double const smallest = 1e-6 * usual;
  double low = smallest, high = largest;  // amplitudes known or taken to be too small, too large
  double x = usual, last_x = 0.0, last_snr = 0.0;
  SizedEffect best;
  double best_distance = std::numeric_limits<double>::infinity();
  for (int run = 0; run < most_runs; ++run) {
    ConcealedEffect const effect = amplify(x)(clean_.rig.joint);
    double const snr = snr_of(effect);
    double const distance = std::abs(std::log(std::max(snr, 1e-12) / wanted_snr));
    if (distance < best_distance) {
      best_distance = distance;
      best = {effect, snr, distance < close_enough};
    }
    if (best.reached || (x == largest && snr < wanted_snr)) return best;
    (snr < wanted_snr ? low : high) = x;

    bool const sloped = last_x > 0.0 && last_snr > 0.0 && std::isfinite(last_snr) && snr != last_snr;
    double const slope = sloped ? std::log(snr / last_snr) / std::log(x / last_x) : 1.0;
    double next = x * std::pow(wanted_snr / snr, 1.0 / std::clamp(slope, 0.3, 3.0));
    if (!(snr > 0.0) || !std::isfinite(snr)) next = std::sqrt(low * high);
    next = std::clamp(next, x / 30.0, x * 30.0);
    // outside the bracket or for long no progress: halve it; at the upper end the largest amplitude is tried itself
    if (next >= high) next = high == largest ? largest : std::sqrt(low * high);
    if (next <= low || (run > 7 && run % 2 == 0)) next = std::sqrt(low * high);
    last_x = x;
    last_snr = snr;
    x = next;
  }
  return best;
}

}  // namespace concealed
