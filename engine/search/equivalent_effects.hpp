#pragma once
// Which other effects explain an accepted effect's part of the torque as well: what cannot be excluded.
//
// Part       mismatch of the final stage plus the accepted effect itself, beside all other effects of the model
// Rival      of the same equivalence families, or with half of its gain in the first scan; its shape refined on that
//            part
// Excluded   when the advantage of the accepted effect over it is larger than
//              what chance gives if the rival were the truth: twins' residuals on top of the rival's torque, and
//              what the accepted effect itself leaves unexplained, for a rival that explains nine tenths as much: a
//              form that is wrong by that much cannot exclude another that is wrong by little more. What begins at an
//              instant fits whatever happened once with the edges it wants: it excludes no law that explains nine
//              tenths as much
// Threads    spreads grid points over `threads`; same bits for any number
// Source     PHYSICS.md section 2 step 10; non-nested models by simulation: Cox 1962, Williams 1970

#include <string>
#include <vector>

#include "engine/search/model_stage.hpp"
#include "engine/search/shape_refinement.hpp"

namespace torquescope {

struct Rival {
  Effect const* effect = nullptr;
  std::vector<double> shape{};
  double gain_ratio = 0.0;  // its gain over the accepted effect's
  double p = 1.0;           // of an advantage this large if the rival were the truth
  bool is_equivalent = false;
};

// the rivals of effect i of the stage's model, strongest first
std::vector<Rival> rivals_of(ModelStage const& stage, std::size_t i, std::vector<Effect const*> const& others,
                             ShapeSearch const& search, int threads);

}  // namespace torquescope
