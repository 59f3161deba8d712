#pragma once
// How well a rigid arm fits a recording under one set-up, on blocks of time that the fit has not seen.
//
// Equation   least squares of all joints together, each weighed by its own residual; blocks of time in turn are fitted
//            and held out. With a free scale, the torque of one joint is known up to a factor that the others tell:
//            the links that move it move them as well
// File       the same with the robot file's own inertias, where it has any: frictions and drive inertias alone are
//            fitted. A file is hardly right to a few percent, but it knows signs, zeros and units
// Columns    base parameters with drive inertias, viscous and Coulomb friction and an offset of each joint
// Rows       those of a joint that moves
// Threads    pure function
// Source     Gautier and Khalil 1990, doi:10.1109/70.56655; weights: Janot, Vandanjon, Gautier 2014,
//            doi:10.1109/TCST.2013.2257774

#include <Eigen/Core>
#include <optional>

#include "engine/diagnose/arms/arm_setup.hpp"
#include "engine/diagnose/arms/gram_fit.hpp"
#include "engine/robot/base_parameters.hpp"

namespace torquescope {

struct SetupFit {
  Eigen::VectorXd error;       // [N] held-out rms over rms of the torque
  Eigen::VectorXd own_error;   // [N] the same of a fit to all blocks, on these: of a short recording it is far lower
  Eigen::VectorXd parameters;  // of the base
  Eigen::VectorXd file_error;  // [N] with the inertias of the robot file; empty: it has none
  Eigen::VectorXd file_scale;  // [N] factor of the torque by which each would agree best
  double scale = 1.0;          // of the joint whose scale is free: what its torque is to be multiplied by
  double score = 0.0;          // sum of the errors' logarithms; lower is better
  double file_score = 0.0;

  static constexpr double floor = GramUnknowns::floor;
};

// base: of the set-up's chain
SetupFit fit_of(ArmSamples const& samples, ArmSetup const& setup, BaseParameters const& base,
                std::optional<Eigen::Index> free_scale = {});

}  // namespace torquescope
