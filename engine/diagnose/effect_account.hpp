#pragma once
// Where an effect of the final model acts and how large it is: its region, its curve, its torque.
//
// Torque     of the effect on the noise-free motion, filtered like the residual, beside the model's own terms. Peak: of
//            the rows in its places, of all rows where its places hold none or are waves
// Region     the interval of its principal axis in which it acts; places: one or two of them (acting_region.hpp); a
//            wave: its order or frequency with half a resolution to both sides. Of every unfiltered sample of the
//            motion, since a delay acts most at reversals, where no row is left
// Curve      means over the map's cells of that axis: effect alone, effect plus what is left, spread of a replicate's
//            mean; waves are drawn over position
// Units      SI
// Threads    free functions

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
