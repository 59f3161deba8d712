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

#include "engine/infer/decision/fitted_model.hpp"
#include "engine/infer/locate/mismatch_rows.hpp"
#include "engine/infer/verdict/diagnosis.hpp"

namespace torquescope {

struct EffectAccount {
  AxisInterval region{};
  std::vector<AxisInterval> places{};
  EffectCurve curve{};
  double rms = 0.0, peak = 0.0;
};

// an effect of a model on the motion and on the rows of a recording
struct EffectOnRecording {
  ShapedEffect const& shaped;
  JointScales const& scales;
  MotionAxes axes{};         // of the samples at which it may act
  Eigen::VectorXd acting{};  // its torque there
  Eigen::VectorXd beside{};  // on the rows: beside the model's own terms
  Eigen::VectorXd whole{};   // on the rows: what is drawn
  MismatchRows const& rows;  // of the model with the effect; in the torque itself
};
EffectAccount account_of(EffectOnRecording const& effect);

// What an effect adds to a baseline that keeps its own level where the level is nobody's: a spring's torque is counted
// from its mean and not from where the encoder reads 0. columns: of the regressor, as `torque` is sampled
Eigen::VectorXd beside_the_level(Regressor const& regressor, Effect const& effect, Eigen::MatrixXd const& columns,
                                 Eigen::VectorXd torque);

// the largest size of a torque on the rows in one of the places; of all rows where none is in them.  at: of the places'
// axis
double peak_in(std::vector<AxisInterval> const& places, Eigen::VectorXd const& at, Eigen::VectorXd const& torque);

}  // namespace torquescope
