#pragma once
// Whether a candidate is only another form of an accepted effect, and so deserves no name of its own.
//
// Form       any function of the effect's principal axis with its parity, as hats over quantiles
// Rule       a candidate is a form when it explains less than a tenth of what the accepted effect explained, and more
//            than half of it lies in that span
// Waves      at the order of an accepted wave or twice that, of another kind, with less than a quarter of its gain
// Threads    free function
// Source     METHOD.md, Conditions of acceptance

#include <cstddef>
#include <optional>
#include <span>

#include "engine/search/model_stage.hpp"
#include "engine/search/shape_refinement.hpp"

namespace torquescope {

// columns: of the stage.  named: an accepted effect of its model; named_gain: in the stage's unit of energy
bool is_form_of(ShapedEffect const& named, double named_gain, RefinedEffect const& candidate, ModelStage const& stage,
                CandidateColumns const& columns);

// The first effect of the stage's model whose form the candidate is; gains: one for each effect of the model, in its
// order, so that two waves of one name each have their own
std::optional<std::size_t> form_of_named(std::span<double const> gains, RefinedEffect const& candidate,
                                         ModelStage const& stage, CandidateColumns const& columns);

}  // namespace torquescope
