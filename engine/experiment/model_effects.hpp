#pragma once
// The model of a diagnosed joint effect by effect: which effect each parameter belongs to, and its torque as code.
//
// Waves      waves of one effect are told apart by the number behind their parameters
// Held       a shape that the joint itself fixes is not among the estimates; it has the value of its upper bound
// Threads    free functions

#include <optional>
#include <string>
#include <vector>

#include "engine/effects/effect.hpp"
#include "engine/infer/verdict/diagnosis.hpp"

namespace torquescope {

struct EstimatedEffect {
  Effect const* effect = nullptr;               // none: no effect of this program has such a parameter
  std::vector<ParameterEstimate> parameters{};  // as stored
  std::vector<ParameterEstimate> held{};        // shapes that are not
  std::string code{};                           // with the names of the parameters; "" with a reason
  std::string why_no_code{};
};

// what the joint is modelled with: with its effects, or without where none stands
std::vector<ParameterEstimate> const& model_of(JointDiagnosis const& joint);
// in the order of their first parameters
std::vector<EstimatedEffect> estimated_effects(JointDiagnosis const& joint);
// the same of terms alone, which need no levels
std::vector<EstimatedEffect> estimated_effects(std::vector<ParameterEstimate> const& parameters,
                                               EffectLevels const& levels = {});

}  // namespace torquescope
