#pragma once
// One effect that the job's model lacks. Names, families and parameters are the words of the engine's catalogue
// (`torquescope describe NAME`); the equations are written here anew, each times an amplitude that is fitted to a size.
//
// torque    of the joint, resists motion like friction does: J dv/dt = given - ... - amplitude torque
// dry       adds amplitude dry to the level of dry friction, which the sticking law passes through rest
// lost      amplitude lost of the drive's torque does not arrive at the joint
// delay     neither: the torque column is late by delay_s

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "sticking/rig.hpp"

namespace sticking {

struct Moment {
  double t = 0.0, q = 0.0, v = 0.0;
  double weight = 0.0;  // torque of gravity
};

struct HiddenEffect {
  std::string name, family, form;
  std::string amplitude_name;  // of the amplitude, in the truth
  std::vector<std::pair<std::string, double>> shapes = {};
  double sign = 1.0;                      // is in the functions already
  double amplitude = 0.0, largest = 0.0;  // from 0 to what the catalogue or physics allows
  std::function<double(Moment const&)> torque = {}, dry = {};
  std::function<double(Moment const&, double given)> lost = {};
  double delay_s = 0.0;
};

// What amplitudes and shapes are relative to
struct Scale {
  Joint joint;
  double centre = 0.0, travel = 0.0, speed = 0.0;  // of the training motion
  double torque_rms = 0.0;
  double highest_hz = 0.0;  // that the job's filter lets pass
};

std::vector<std::string> const& effect_names();
bool needs_gravity(std::string const& name);
HiddenEffect draw_effect(std::string const& name, Scale const& scale, Chance& chance);

constexpr double shortest_delay_s = 3e-3, longest_delay_s = 20e-3;

}  // namespace sticking
