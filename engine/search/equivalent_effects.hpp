#pragma once
// Which other effects explain an accepted effect's part of the torque as well, and so cannot be excluded.
//
// Part       mismatch of the final stage plus the accepted effect itself, beside all other effects of the model
// Rival      of the same equivalence families, or with half of its gain in the first scan; its shape refined on that
//            part
// Excluded   when the accepted effect's advantage is larger than chance gives with the rival as the truth (5 %), and,
//            for a rival that explains nine tenths as much, than what the accepted effect itself leaves. An event
//            excludes no law that explains nine tenths as much
// Threads    spreads grid points over `threads`; same bits for any number
// Source     Cox 1962, doi:10.1111/j.2517-6161.1962.tb00468.x; Williams 1970, doi:10.2307/2529041

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
