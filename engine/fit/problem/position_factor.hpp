#pragma once
// A position that was taken in the wrong unit, told by the torque: sin(f q) fits for one f alone.
//
// Equation   e(f) = min ||tau - phi(f q) parameters|| / ||tau||; asked of models with an effect that is no power of q
// Tried      units that people forget (known_factors.hpp), and every f < 1 with which the joint turns between half a
//            radian and two turns: the ratio of a gear. The sign is not among them: it only turns parameters round
// Told       e(1) is at least five times e(f); e(f / 2), e(2 f) and the error of the model as written beside a spring
//            are larger beyond chance: where the factor is not known, or a spring is all that is missing, nothing is
//            said
// Shapes     at most 2048 rows are looked at; columns of f are not filtered, as they are far slower than the cut-off
// Threads    free functions

#include <optional>
#include <string>

#include "engine/effects/regressor.hpp"
#include "engine/fit/problem/regression_data.hpp"

namespace torquescope {

// a term whose column for f q is no multiple of that for q: without one no error depends on the unit
bool tells_unit_of_position(Regressor const& regressor);

struct PositionFactor {
  double factor = 1.0;
  std::string words{};                           // "degrees"; empty: no unit that is known, f < 1 may be a gear's
  double error_before = 0.0, error_after = 0.0;  // relative
};

// needs data.q, and velocity() and acceleration()
std::optional<PositionFactor> position_factor(RegressionData const& data, Regressor const& regressor);

}  // namespace torquescope
