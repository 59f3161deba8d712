#pragma once
// What a right name with a form that is a little wrong leaves: nothing that deserves a name of its own.
//
// Form       the effect's principal axis says what it is a function of and its parity whether along the motion or not;
//            any such function of the axis, as hats over its quantiles, is a form the same physics could have
// Rule       a candidate is the form of a named effect when it explains less than a tenth of what that explained, and
//            more than half of it lies in that effect's form. A tenth is what the form of a law may cost elsewhere as
//            well (equivalent_effects.hpp)
// Waves      their axis is a spectrum. An order belongs to one part of the machine: what goes with the order of a named
//            wave or with twice that, has another kind, and explains less than a quarter of what that explained, is the
//            form of that wave's law (where friction and inertia sit before or behind the gear's error, whether a
//            magnet's pull depends on its current)
// Threads    free function
// Source     LESSONS items 11 and 18 of our own prototype: what slightly wrong shapes leave must not take a second name

#include "engine/search/model_stage.hpp"
#include "engine/search/shape_refinement.hpp"

namespace torquescope {

// columns: of the stage.  named: an effect of its model; named_gain: in the stage's unit of energy
bool is_form_of(ShapedEffect const& named, double named_gain, RefinedEffect const& candidate, ModelStage const& stage,
                CandidateColumns const& columns);

}  // namespace torquescope
