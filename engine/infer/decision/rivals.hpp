#pragma once
// Effects that could stand in the place of one that was taken about as well: with it, they are a class.
//
// As good    D within chance of the effect's, or a judged error that is not higher by least_fall; and D that chance
//            alone does not give
// Stands     the one that judged rows are predicted best with, where there are validation recordings. A weight stands
//            before a spring: every link has one unless its axis is upright, few have a spring
// Threads    spreads effects over the threads of the question; same bits for any number
// Source     engine/infer/decision/THEORY.md, The rules

#include <span>

#include "engine/infer/decision/accepted_model.hpp"

namespace torquescope {

// with the rivals of the effect at this place; one that stands in its stead goes to the end
AcceptedModel with_rivals(DecisionContext const& on, AcceptedModel model, std::size_t place,
                          std::span<StepFacts const> steps);

}  // namespace torquescope
