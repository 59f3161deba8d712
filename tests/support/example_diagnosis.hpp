#pragma once
// An INVENTED diagnosis with every kind of thing a diagnosis can hold: no recording was ever diagnosed for it. What the
// tests of words, files, tables and the page are fed with, and nothing else.
//
// Tells      a revolute joint lacks Stribeck friction (presliding cannot be excluded) and cogging; the map has all nine
//            axes, the table 34 candidates, the trace three laps of 8 s at 100 Hz
// Bits       the same in every call: formulas, no random numbers

#include "engine/infer/verdict/diagnosis.hpp"

namespace torquescope::example {

// named, the strongest effect with an equivalent that cannot be excluded
Diagnosis invented_diagnosis();

// the same joint with one of two effects, which the motion cannot tell apart, with two effects that explain a part,
// with nothing missing, with one repeating structure that has no name, hardly moving, and with a late torque channel
Diagnosis invented_class();
Diagnosis invented_partly();
Diagnosis invented_none();
Diagnosis invented_unexplained();
Diagnosis invented_insufficient();
Diagnosis invented_data_fault();

}  // namespace torquescope::example
