#pragma once
// The amplitude at which an effect has the wanted size.
//
// Size       SNR_eff of effect_size.hpp: residual of the baseline fitted to the run without noise, over the noise of a
//            run without the effect
// Method     secant steps on the logarithms, kept inside the bracket found so far
// Accuracy   within `close_enough` of the wanted size where the effect reaches it below its largest amplitude; a run in
//            which the loop loses its joint counts as too large
// Threads    one object, one thread

#include "concealed/case_list.hpp"
#include "concealed/drawable_effects.hpp"

namespace concealed {

inline constexpr double close_enough = 0.02;
// coarser than the case itself is made: sizes differ by less than close_enough
inline constexpr double sizing_step_s = 50e-6;

struct SizedEffect {
  ConcealedEffect effect;
  double snr = 0.0;
  bool reached = false;
};

class Sizing {
 public:
  // rig, training motion and seed of this case; its effects do not matter
  explicit Sizing(Case const& clean);
  double noise_rms() const { return noise_rms_; }
  SizedEffect find(Amplifier const& amplify, double usual, double largest, double wanted_snr) const;

 private:
  double snr_of(ConcealedEffect const& effect) const;

  Case clean_;
  double noise_rms_ = 0.0;
};

}  // namespace concealed
