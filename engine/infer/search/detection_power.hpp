#pragma once
// What a verdict "nothing is missing" is worth: the smallest effect that would have opened the gates.
//
// Effect     Stribeck friction at a twentieth of the peak speed, exponent 1, and any torque beside the model's columns
// Gate       overall z and share of the torque of selection.hpp
// Threads    free function

#include <string>

#include "engine/infer/search/model_stage.hpp"

namespace torquescope {

// "A Stribeck effect of 5 % of the Coulomb friction would have shown."; "" when the model has no dry friction
// of any missing torque that the model's own terms do not imitate, as a share of the torque's rms
double smallest_visible_share(ModelStage const& stage);

std::string power_sentence(ModelStage const& stage);

}  // namespace torquescope
