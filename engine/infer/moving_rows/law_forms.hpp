#pragma once
// What a law of another form would be: smooth functions of its own axis, with its own parity.
//
// Why        no catalogue has every form of a friction curve or a spring. What such a correction explains is no other
//            physics, and a law may be off by as much as DecisionLevels::tolerance of its torque and still be right
// Forms      hats over quantiles of the principal axis, 12 knots; of velocity: over the speed; times the direction of
//            motion for an odd law, as they are for an even one, both for one that is neither. None for waves, laws of
//            a clock and laws without an axis
// Shapes     n samples at the full rate x forms
// Threads    pure function
// Source     hats: Eilers, Marx 1996, doi:10.1214/ss/1038425655 (splines of order 1)

#include <Eigen/Core>

#include "engine/infer/search/model_stage.hpp"

namespace torquescope {

// of all accepted laws but `without`, side by side, on the motion of a record; no columns where none has any. model:
// the stage's, with the load of that recording
Eigen::MatrixXd forms_of_laws(ModelStage const& stage, JointModel const& model, ProcessedRecord const& record,
                              std::size_t without);

}  // namespace torquescope
