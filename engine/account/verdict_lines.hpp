#pragma once
// A verdict in a line or two: what is missing with its numbers and their intervals, then the errors over all samples.
//
// What       "Stribeck friction 0.11 N m [0.10, 0.12], stribeck_speed 0.08 rad/s [0.07, 0.09]   p < 0.005"; of a class
//            its members, strongest first, three at most; where nothing is named, what the residual looks like
// Errors     "error, all samples: training 13.1 -> 10.4 %, validation 13.1 -> 10.4 %": before and after
// Units      of the parameters, as the joint has them
// Threads    pure functions

#include <string>
#include <vector>

#include "engine/infer/verdict/diagnosis.hpp"

namespace torquescope {

struct VerdictLines {
  std::string what;
  std::string errors;                // "" where none was measured
  std::vector<std::string> remarks;  // what was done to the channels; that a validation recording is of another kind
};

// verdict: of the joint, or of the whole diagnosis where it has one joint
VerdictLines verdict_lines(Diagnosis const& diagnosis, JointDiagnosis const& joint, Verdict verdict);

// of an arm: the effects of the whole, and the error over all joints and samples
VerdictLines arm_lines(Diagnosis const& diagnosis);

// what of the whole diagnosis, in one line: what terminal, JSON and page begin with
std::string headline_of(Diagnosis const& diagnosis);

}  // namespace torquescope
