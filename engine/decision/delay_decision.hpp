#pragma once
// Whether the delay that stands beside a model is a name: the torque comes late or early by more than a recording may.
//
// Allowed    from 0 to half a sample, which a log that does not hold its torque has
// Equation   D and size against the same model at the nearest allowed delay; chance: D of replicates, which search
//            their delay alike
// Threads    pure functions
// Source     engine/decision/THEORY.md, The rules

#include <span>

#include "engine/decision/fitted_model.hpp"

namespace torquescope {

// chance: D of delays of replicates
DelayFacts decided_delay(DecisionQuestion const& question, JointStrips const& rows, FittedModel const& model,
                         std::span<double const> chance);

// the nearest delay that says nothing
double allowed_delay(FittedStrips const& fitted);
FittedModel at_allowed_delay(JointStrips const& rows, FittedModel const& model);
double delay_gain(FittedStrips const& fitted, FittedStrips const& at_allowed);

}  // namespace torquescope
