#pragma once
// A rig and its motions drawn from a stream of random numbers: joint, friction, loop, noise, encoder.
//
// Loops      PD, PID and cascade, in four of ten cases with feedforward of a model that is up to a tenth wrong
// Threads    free functions

#include <string>
#include <vector>

#include "concealed/case_list.hpp"
#include "concealed/noise.hpp"

namespace concealed {

std::vector<std::string> const& all_joint_names();

// the joint's numbers vary by up to half around the named one
Rig drawn_rig(Random& random, std::vector<std::string> const& joints, std::vector<std::string> const& noises);

struct Motions {
  Recipe train, validate;
  double train_s = 40.0, validate_s = 20.0;
};
// rich enough to tell the effects of the catalogue apart: mixed, staircase or multisine
Motions drawn_motions(Random& random);
// any motion a machine makes, with records of 40 s or, at work, of 20 s
Motions drawn_everyday_motions(Random& random);

}  // namespace concealed
