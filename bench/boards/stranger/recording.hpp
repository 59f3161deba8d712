#pragma once
// Runs a case and writes down what its logger sees.
#include <vector>

#include "stranger/case.hpp"

namespace stranger {

struct Sample {
  double t, reference, position, velocity, torque;
  double unexplained;  // mean since the last sample; never written beside the recording
};

struct Options {
  bool without = false;  // nothing is concealed: same motion, same noise
  int only = -1;         // of several laws the one of this number; negative: all
  double scale = 1;      // of every law's first value
  int steps_per_tick = 2;
  bool noise = true;   // of the torque channel and the tachometer
  bool pushes = true;  // the coloured torque from outside
};

// motion "train" or "unseen"
std::vector<Sample> record(Case const& which, bool validation, Options const& options);

}  // namespace stranger
