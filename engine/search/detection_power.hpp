#pragma once
// What a verdict "nothing is missing" is worth: the smallest effect that would have opened the gates.
//
// Effect     Stribeck friction at a twentieth of the peak speed, exponent 1, and any torque beside the model's columns
// Gate       overall z and share of the torque of forward_selection.hpp
// Threads    free function

#include <string>

#include "engine/search/model_stage.hpp"

namespace torquescope {

// "A Stribeck effect of 5 % of the Coulomb friction would have shown."; "" when the model has no dry friction
std::string power_sentence(ModelStage const& stage);

}  // namespace torquescope
