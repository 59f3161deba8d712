#pragma once
// Whether a recording that is predicted has another level of dry friction than the training recording: joints warm up,
// and are loaded and lubricated differently from day to day.
//
// Equation   residual = d sign(dq) + c; d is there when it predicts blocks left out clearly better than c alone
//            (blocked_cv.hpp, held_out_gain.hpp). A joint that moves one way has c alone, which is friction or offset
// Never      part of a prediction: a level is fitted to the recording that it is told of
// Shapes     of a trace: n rows
// Units      N m or N
// Threads    pure function
// Source     Bittencourt, Gunnarsson 2012, doi:10.1115/1.4006589 (friction of a robot joint: temperature, load, wear)

#include <Eigen/Core>
#include <optional>

#include "engine/infer/verdict/diagnosis.hpp"

namespace torquescope {

// residual: of the model that is told, a row each, none where the model drops it; memory: rows that a filter couples;
// least_fall: of the error, as a share
std::optional<LevelChange> level_change(TorqueTrace const& trace, Eigen::VectorXd const& residual, Eigen::Index memory,
                                        double least_fall);

}  // namespace torquescope
