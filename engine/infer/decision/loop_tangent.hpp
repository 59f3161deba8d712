#pragma once
// A model in its loop as a plane: what it leaves of recordings, and how that changes with each parameter. Replicates of
// the model then cost a product, not a search.
//
// Plane      residual - jacobian * step, all tracks below each other; central differences of 8e-3 of a scale
// Step       least squares, each channel by its own noise; a step of one scale costs one unit of the statistic
// Shapes     of each channel that counts: jacobian [samples][parameters], residual [samples]
// Units      a parameter by its scale
// Threads    pure functions
// Source     score tests by one step: Le Cam 1956; van der Vaart 1998, Asymptotic Statistics, section 5.7,
//            doi:10.1017/CBO9780511802256

#include <Eigen/Core>
#include <array>
#include <vector>

#include "engine/simulate/rollout/fit_unknowns.hpp"

namespace torquescope {

using ChannelRows = std::array<Eigen::MatrixXd, n_channels>;

struct LoopTangent {
  ChannelRows jacobian{};
  ChannelRows residual{};  // one column
};

LoopTangent tangent_at(FitUnknowns const& unknowns, FitPoint const& at);
// columns of some parameters alone; of several points with the same model they are simulated side by side
std::vector<ChannelRows> columns_at(FitUnknowns const& unknowns, std::vector<FitPoint> const& at,
                                    std::vector<Eigen::Index> const& parameters);
LoopTangent beside(LoopTangent tangent, ChannelRows const& columns);

// squares that a step leaves of each column of rows, which are residuals of the plane `from`: [columns] of each channel
struct StepLeft {
  std::array<Eigen::VectorXd, n_channels> squares{};
  Eigen::MatrixXd step{};  // [parameters][columns]
};
StepLeft left_after_step(LoopTangent const& to, LoopTangent const& from, ChannelRows const& rows,
                         ChannelNumbers const& weights);

}  // namespace torquescope
