#pragma once
// What a diagnosis of an arm says in one paragraph: which joints lack what, and the error over all joints.
//
// Threads    pure functions

#include <string>
#include <vector>

#include "engine/infer/verdict/diagnosis.hpp"

namespace torquescope {

// "Named at joint 2 (load dependent friction) and joint 3 (stribeck); unexplained at joint 1; nothing missing at joints
// 4, 5 and 6. Validation relerr over all joints 4.5 % to 2.1 %."
std::string arm_reason_sentence(Diagnosis const& diagnosis);

// "From 9.0 s of monday.csv on all joints feel a payload of the last link, picked up or put down (payload_mass 1.2 kg):
// on rows left out relerr over all joints falls from 12 % to 1.3 %."; recording: "" where it acts everywhere
struct WholeArmFacts {
  std::string recording{};
  double from_s = 0.0, until_s = 0.0;                      // until: infinite where it acts to the end
  double before = 0.0, after = 0.0;                        // relerr on rows left out
  double validation_before = 0.0, validation_after = 0.0;  // 0: it acts in no validation recording
  // of an event: where it acts in validation recordings
  struct There {
    std::string recording{};
    double from_s = 0.0, until_s = 0.0;
  };
  std::vector<There> validation{};
};
std::string whole_arm_sentence(NamedEffect const& effect, WholeArmFacts const& facts);

// "Parameters are fitted to monday.csv and tuesday.csv together."
std::string several_recordings_sentence(std::vector<std::string> const& recordings);

// "payload_change fitted to all of its rows", of what a recording to predict has at another time or phase
std::string refitted_clause(std::string const& effect);

// "The joint compliance of the whole arm explains 82 % of this joint's mismatch; of what is left:"
std::string explained_by_arm_sentence(std::string const& effect, double share);

// "The masses that the rows of this joint tell are not those of the other joints: its relerr is 1.3 % with its own, and
// 4.6 % with those that all share."
std::string own_masses_sentence(double own_relerr, double shared_relerr);

}  // namespace torquescope
