#pragma once
// What effects of an instant or a clock do in a recording that their fit has not seen.
//
// Carried    a wave per second keeps its frequency; its size and phase are fitted there. Of a warm-up a share, 0 to 1.
//            An event has an instant and a size of its own where one explains more than chance does (own_event.hpp);
//            else it says nothing there (effects/carry_over.hpp)
// Fitted     to all rows of that recording, so they never raise its error: whether such an effect is there is judged
//            on held-out folds of training
// Shapes     n rows of one strip
// Threads    pure functions
// Source     engine/infer/decision/THEORY.md, The rules

#include <cstdint>

#include "engine/infer/decision/treated_fit.hpp"

namespace torquescope {

// parameters of the model without those of effects that say nothing elsewhere as they are
Eigen::VectorXd without_clock(JointModel const& model, Eigen::VectorXd parameters);

// one strip on which a model is tried, and how its samples count
struct ElsewhereRows {
  ModelOnStrips const& on;  // of one strip
  std::vector<SampleTreatment> const& samples;
  Eigen::VectorXd const& parameters;  // of training
  Eigen::VectorXd const& constant;    // the recording's offset, on its rows; zero: none
};

// residual of the model without_clock(), less what its effects of a clock explain there
Eigen::VectorXd less_own_clock(ElsewhereRows const& rows, Eigen::VectorXd residual);

}  // namespace torquescope
