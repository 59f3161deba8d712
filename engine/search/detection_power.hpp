#pragma once
// What a verdict "nothing is missing" is worth: the smallest effect that would have been told.
//
// Effect     Stribeck friction at a twentieth of the peak speed, exponent 1: the textbook's first suspect
// Told       when its part beside the model is large enough for the gates of forward_selection.hpp
// Threads    free function

#include <string>

#include "engine/search/model_stage.hpp"

namespace torquescope {

// "A Stribeck effect of 5 % of the Coulomb friction would have shown."; "" when the model has no dry friction
std::string power_sentence(ModelStage const& stage);

}  // namespace torquescope
