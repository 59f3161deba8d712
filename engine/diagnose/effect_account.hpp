#pragma once
// Where an effect of the final model acts and how large it is: its region, its curve, its torque.
//
// Torque     of the effect on the common motion, filtered like the residual, on the rows; without what the model's own
//            terms would imitate of it. Its peak is that of the rows in its places, so that a size and a place that are
//            told in one sentence belong together; of all rows where its places hold none, or are waves
// Region     the interval of its principal axis in which it acts, places: one or two of them (acting_region.hpp); a
//            wave: its order or frequency with half a resolution to both sides. Of every sample of the motion, not
//            filtered: a delay acts most where the joint turns round, and no row is left there. What opposes the motion
//            has no place in rests
// Curve      means over the cells of the mismatch map of that axis: effect alone, effect plus what is left, and the
//            spread of one twin's mean; waves are drawn over position
// Units      SI
// Threads    free functions
// Source     UX.md section 3 item 3

#include "engine/search/model_stage.hpp"
#include "engine/verdict/diagnosis.hpp"

namespace torquescope {

struct EffectAccount {
  AxisInterval region{};
  std::vector<AxisInterval> places{};
  EffectCurve curve{};
  double rms = 0.0, peak = 0.0;
};

EffectAccount account_of(ModelStage const& stage, std::size_t i);

// the largest size of a torque on the rows in one of the places; of all rows where none is in them.  at: of the places'
// axis
double peak_in(std::vector<AxisInterval> const& places, Eigen::VectorXd const& at, Eigen::VectorXd const& torque);

}  // namespace torquescope
