#pragma once
// The effects that cases are drawn from: every single-joint effect of the catalogue, and some outside of it.
//
// Shape      what is no amplitude (speeds, orders, times, phases) is drawn from a stream of random numbers
// Amplitude  one number per effect, largest: beyond it no real joint goes; sizing.hpp finds the one that is wanted
// Threads    free functions

#include <cstdint>
#include <string>
#include <vector>

#include "concealed/concealed_effects.hpp"
#include "concealed/noise.hpp"

namespace concealed {

using Amplifier = std::function<EffectMaker(double amplitude)>;

struct DrawableEffect {
  std::string name;                 // of the catalogue, or "outside_..." for what it does not hold
  std::vector<std::string> joints;  // it is put into one of these
  double usual = 0.0, largest = 0.0;
  Amplifier (*draw)(Random&, JointDesign const&);
};

std::vector<DrawableEffect> const& catalogue_effects();
std::vector<DrawableEffect> const& outside_effects();
// Errors: std::invalid_argument for an unknown name
DrawableEffect const& drawable_effect(std::string const& name);

}  // namespace concealed
