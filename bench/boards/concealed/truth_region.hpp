#pragma once
// Where an effect lives: the samples that hold 80 % of the energy it injects, seen along one axis.
//
// Bins       100 per axis; a bin is inside when, taken in the order of mean energy per sample, it belongs to the first
//            bins that hold 80 % of the energy. Distances since a reversal are binned by their logarithm
// Axes       time, position, velocity, acceleration, load, since_velocity_reversal, since_torque_reversal: the engine's
//            words. Load along the motion, as there: above zero the motor drives. Torque that reverses: inertia,
//            gravity and friction of the baseline, which backlash has to transmit
// Units      those of the axis: s, rad or m, rad/s or m/s, rad/s^2 or m/s^2, N m or N

#include <string>
#include <utility>
#include <vector>

#include "concealed/closed_loop.hpp"

namespace concealed {

struct TruthRegion {
  std::string axis;
  std::vector<double> edges;      // bins + 1
  std::vector<double> occupancy;  // share of the samples in each bin
  std::vector<bool> inside;
  std::vector<std::pair<double, double>> intervals() const;  // neighbouring inside bins joined
};

std::vector<std::string> const& truth_axes();
// one per axis, in that order
std::vector<TruthRegion> truth_regions(Truth const& truth, std::vector<double> const& added, Baseline const& baseline);

}  // namespace concealed
