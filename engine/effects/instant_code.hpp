#pragma once
// The torque of an effect as an expression in C, for programs that do not have the engine.
//
// Words      its own parameters by name; q, dq, ddq; s: the sign of dq (0 at rest); friction_sign:
//            JointScales::friction_sign() of dq; load: JointState::load_torque; baseline_inertia: JointScales::inertia;
//            fabs, pow, exp, sqrt, sin, cos of <math.h>
// Units      SI, as Effect::torque(), which it equals but for rounding (tests/unit/effects/instant_code.cpp)
// Threads    free functions

#include <map>
#include <string>

#include "engine/effects/effect.hpp"

namespace torquescope {

// whether a word of C stands in the expression
bool has_word(std::string const& code, std::string const& word);
// every word that is a key becomes its value
std::string with_words(std::string const& code, std::map<std::string, std::string> const& words);
// "depends on the motion before": why an effect has no code; "" when it has
std::string why_no_code(Effect const& effect);

}  // namespace torquescope
