#pragma once
// Where an effect of the final model acts and how large it is: its region, its curve, its torque.
//
// Torque     of the effect on the common motion, filtered like the residual, on the rows
// Region     the shortest interval of its principal axis that holds 80 % of its energy; a wave: its order or frequency
//            with half a resolution to both sides
// Curve      means over the cells of the mismatch map of that axis: effect alone, effect plus what is left, and the spread
//            of one twin's mean; waves are drawn over position
// Units      SI
// Threads    free functions
// Source     UX.md section 3 item 3

#include "engine/diagnose/diagnosis.hpp"
#include "engine/diagnose/model_stage.hpp"

namespace torquescope {

struct EffectAccount {
  AxisInterval region{};
  EffectCurve curve{};
  double rms = 0.0, peak = 0.0;
};

EffectAccount account_of(ModelStage const& stage, std::size_t i);

// shortest interval of `at` that holds this share of the summed weights
std::pair<double, double> shortest_interval(Eigen::VectorXd const& at, Eigen::VectorXd const& weight, double share);

}  // namespace torquescope
