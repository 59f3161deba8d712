#pragma once
// Columns of terms and effects on a strip, where dry friction is not yet decided: for a joint that moves forward, and
// for the same one moving back.
//
// Equation   column = (1 + s) / 2 forward + (1 - s) / 2 backward of dry friction; the same in both of everything else
// Memory     an effect that remembers the motion is as its motion says, dry or not
// Shapes     n samples at the effects' rate x k columns; driven ones at the drive's rate
// Threads    pure functions
// Source     engine/infer/decision/THEORY.md, Rows

#include <Eigen/Core>
#include <span>
#include <vector>

#include "engine/infer/decision/strip.hpp"

namespace torquescope {

struct EffectColumnsOnStrip {
  Eigen::MatrixXd forward{}, backward{};  // backward: of the dry columns alone, in their order
  std::vector<Eigen::Index> dry{};        // ascending
  bool is_driven = false;                 // at the drive's rate

  Eigen::Index count() const { return forward.cols(); }
};

// of several shapes of one effect, one after the other. baseline: load, model torque and sizes on that strip
EffectColumnsOnStrip columns_of(Effect const& effect, std::vector<std::vector<double>> const& shapes,
                                Strip const& strip, FittedBaseline const& baseline);
EffectColumnsOnStrip columns_of(Regressor const& regressor, Strip const& strip);

// with friction as s says at each sample, the samples weighed; on the strip's rows
Eigen::MatrixXd on_rows(Strip const& strip, EffectColumnsOnStrip const& columns, Eigen::VectorXd const& sticking,
                        Eigen::VectorXd const& weight);

}  // namespace torquescope
