#pragma once
// Instruments of an arm's recordings: the regressor along the motion that the identified arm makes, without noise, on
// the recorded references.
//
// Loops      of each joint a linear controller (simulate/controller_fit.hpp), found beside the torque that the arm
//            needs on its reference (computed torque) and without it: the one that leaves less
// Rows       those of the recording: its masks, its gaps, its filter
// Errors     Error 78: no reference, at the estimator that needs one. Error 65 of the function: the arm runs away
// Threads    the function is const
// Source     Janot, Vandanjon, Gautier 2014, doi:10.1109/TCST.2013.2246163

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "engine/data/recording.hpp"
#include "engine/fit/problem/recorded_rows.hpp"

namespace torquescope {

// what is kept of a recording while its rows are made
struct ArmTrack {
  std::vector<Recording> joints;
  std::vector<std::vector<bool>> moves;  // as make_recorded_rows()
};

// what all recordings share
struct InstrumentPlan {
  ArmModel model;
  FilterOptions filter;
  Section section;        // [filter], for the places in messages
  Eigen::VectorXd scale;  // of each joint's rows
};

std::function<Eigen::MatrixXd(Eigen::VectorXd const&)> instruments_of(std::vector<ArmTrack> tracks,
                                                                      InstrumentPlan plan);

}  // namespace torquescope
