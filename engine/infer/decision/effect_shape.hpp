#pragma once
// The shape of one effect that leaves the least on held-out rows, beside its best point of the grid.
//
// Search     along each shape in turn, in the unit scale of its bounds, from a grid's step down to a thousandth; never
//            to a shape where the effect is another than its name says
// Bound      a shape at its end is put in the middle of its range and the others searched again; the effect is at its
//            bound where more than least_fall of the gain is gone
// Threads    pure function; deterministic
// Source     compass search: Kolda, Lewis, Torczon 2003, doi:10.1137/S003614450242889

#include <vector>

#include "engine/infer/decision/effect_scan.hpp"

namespace torquescope {

struct RefinedEffect {
  std::vector<double> shape{};
  double gain = 0.0;             // D
  bool is_at_bound = false;      // its D hangs on a shape at an end of its range which is no effect of its own
  double rms = 0.0;              // of its torque beside the model, on the rows
  Eigen::VectorXd parameters{};  // linear ones
};

RefinedEffect refined_effect(EffectQuestion const& question, EffectFinding const& from, FittedStrips const& fitted,
                             Score const& score, double least_fall);

}  // namespace torquescope
