#pragma once
// What makes a diagnosis of a recording hopeless before it begins: the finding and the way out, no search.
//
// Rule       limits: METHOD.md, A first look. insufficient: the motion is too small. data fault: the torque
//            channel is held too long, or has the wrong sign. What else a motion lacks closes effects
//            (motion_limits.hpp)
// Silence    "mostly one speed" is checked only when nothing was found: such a motion cannot show effects of the speed
// Units      as Excitation
// Threads    free function

#include <optional>
#include <string>

#include "engine/data/excitation.hpp"
#include "engine/infer/pipeline/record_pipeline.hpp"
#include "engine/infer/verdict/diagnosis.hpp"

namespace torquescope {

struct Hopeless {
  Verdict verdict = Verdict::insufficient;
  std::string finding;  // a clause
  std::string way_out;
};

std::optional<Hopeless> check_recording(Excitation const& facts);

// of a recording where nothing was found to be missing: whether its motion could have shown it
std::optional<Hopeless> check_silence(Excitation const& facts);

// record: of the baseline, with its motion
std::optional<Hopeless> check_sign(ProcessedRecord const& record);

}  // namespace torquescope
