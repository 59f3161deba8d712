#pragma once
// What effects need to know of the model that was fitted before them: its levels, and its torque on the motion.
//
// Load torque   terms that depend on position or acceleration: gravity, springs, inertia
// Model torque  all terms: what the motor gives, without the noise of the torque channel (columns made of the measured
//               torque would carry the noise of the response)
// Gear load     of other joints or a simulator: it was taken out of the torque channel, but the motor gives it
// Lives         input() looks into this object and the motion: keep both
// Threads       const object

#include <Eigen/Core>
#include <span>

#include "engine/effects/effect.hpp"
#include "engine/effects/regressor.hpp"

namespace torquescope {

struct FittedBaseline {
  JointScales scales;
  Eigen::VectorXd load_torque;   // n_samples, full rate
  Eigen::VectorXd model_torque;  // n_samples, full rate

  EffectInput input(Motion const& motion) const {
    auto const n = static_cast<std::size_t>(motion.q.size());
    return {motion, scales, {load_torque.data(), n}, {model_torque.data(), n}};
  }
};

// sizes of the motion and of the motor's torque; the levels of a baseline stay 0
// Requires   at least two samples
JointScales measure_scales(Motion const& motion, JointKind joint, double cutoff_hz, double encoder_step,
                           Eigen::VectorXd const* gear_load = nullptr);

// what a recording brings beside its motion; none
struct BesideMotion {
  GivenSignals const* given = nullptr;
  Eigen::VectorXd const* gear_load = nullptr;  // n_samples
};

// cutoff_hz of the parallel filter; encoder_step 0: unknown; parameters: regressor.size()
FittedBaseline fitted_baseline(Regressor const& regressor, std::span<double const> parameters, Motion const& motion,
                               double cutoff_hz, double encoder_step, BesideMotion const& beside = {});

}  // namespace torquescope
