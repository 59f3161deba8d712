#pragma once
// Whether the delay that stands beside a model is a name: the torque comes late or early by more than a recording may.
//
// Allowed    a sample either way of half a sample: when in its sample a drive reads its torque, and whether the log
//            holds it, nobody can tell from a finding; so from half a sample early to one and a half late
// Equation   D and size against the same model at the nearest allowed delay; chance: D of replicates, which search
//            their delay alike
// Threads    pure functions
// Source     engine/infer/decision/THEORY.md, The rules

#include <span>

#include "engine/infer/decision/fitted_model.hpp"

namespace torquescope {

// chance: D of delays of replicates
DelayFacts decided_delay(DecisionQuestion const& question, JointStrips const& rows, FittedModel const& model,
                         std::span<double const> chance);

// the nearest delay that says nothing
double allowed_delay(FittedStrips const& fitted);
FittedModel at_allowed_delay(JointStrips const& rows, FittedModel const& model);
double delay_gain(FittedStrips const& fitted, FittedStrips const& at_allowed);

}  // namespace torquescope
