#pragma once
// What makes a diagnosis of a recording hopeless before it begins: no search, no name, a way out.
//
// Insufficient   one direction, one speed, hardly more than the encoder's steps, too short
//                a motion that keeps to one speed and only ramps through the others shows what happens at places, so it
//                is searched; but when nothing is found, that says nothing of laws of the speed
// Data fault     the torque channel sits at its limit, is held so long that it has less than four values in a period of
//                the filter's cut-off (it would be late by an eighth of one), has nothing to do with the motion, or its
//                sign is wrong: it takes work out of a joint that only has friction, and the fit asks for less inertia
//                or friction than none
// Units          as Excitation
// Threads        free function
// Source         PHYSICS.md section 2 step 1; UX.md section 3 (abstention)

#include <optional>
#include <string>

#include "engine/data/excitation.hpp"
#include "engine/pipeline/record_pipeline.hpp"
#include "engine/verdict/diagnosis.hpp"

namespace torquescope {

struct Hopeless {
  Verdict verdict = Verdict::insufficient;
  std::string finding;  // a clause
  std::string way_out;
};

// relerr: of the baseline on the recording it was fitted to
std::optional<Hopeless> check_recording(Excitation const& facts, double relerr);

// of a recording where nothing was found to be missing: whether its motion could have shown it
std::optional<Hopeless> check_silence(Excitation const& facts);

// record: of the baseline, with its motion
std::optional<Hopeless> check_sign(ProcessedRecord const& record);

}  // namespace torquescope
