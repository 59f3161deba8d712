#pragma once
// F and CR of single trials: how JADE and its successors draw them, and what adaptive evolutions report of them.
//
// Equation   F ~ Cauchy(F_0, 0.1), again while F <= 0, at most 1;  CR ~ Normal(CR_0, 0.1), clipped to 0 .. 1
// Random     one draw for CR, then one or more for F
// Source     Zhang, Sanderson: JADE, IEEE TEC 13 (2009), section IV, doi:10.1109/TEVC.2009.2014613

#include <cstddef>
#include <functional>
#include <span>
#include <vector>

#include "engine/base/random_stream.hpp"
#include "engine/fit/optim/generational_search.hpp"

namespace torquescope {

struct TrialControls {
  double F = 0.0;
  double CR = 0.0;
};

TrialControls draw_round(TrialControls const& centre, RandomStream& random);

// of one member, from the beginning of its trial's stream
using DrawControls = std::function<TrialControls(std::size_t member, RandomStream& random)>;

// what the trials of a generation were made with: drawn anew from the same streams, so no part of a state
std::vector<TrialControls> controls_of_trials(TrialStreams const& streams, std::size_t n_members,
                                              DrawControls const& draw);

// F and CR: means of the generation's trials; PC, FC: as DE's
void record_step(Selected const& step, std::span<TrialControls const> controls, Bounds const& bounds,
                 Progress& progress);

}  // namespace torquescope
