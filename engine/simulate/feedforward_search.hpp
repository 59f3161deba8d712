#pragma once
// Which terms of the reference a controller feeds forward, beside its linear law: friction, gravity.
//
// Search     terms join one at a time: the one of a grid (widths of a smooth sign over three decades, spans and leads
//            of a few samples; sine and cosine of the reference) that takes most of the residual's energy, projected on
//            what the linear columns leave; a smooth sign's width is then refined. Sums of smooth signs are any odd
//            curve that levels off
// Stop       when the first term takes less than a tenth of what is left (on real machines that is no feedforward: EMPS
//            has none, and its residual gives a tanh one in a hundred), or a term is not beyond chance for a search
//            over that many: F-like statistic with as many independent samples as the residual's memory leaves, against
//            z^2 + 2 log(candidates), z = 3.29 (0.1 %)
// Shapes     as controller_regression.hpp; returned terms carry no gain
// Threads    free function
// Source     projection: Golub, Pereyra 1973; friction and gravity fed forward from the desired motion: Siciliano et
//            al., Robotics (2009) section 8.5

#include <vector>

#include "engine/simulate/controller_regression.hpp"
#include "engine/simulate/reference_term.hpp"

namespace torquescope {

// columns: the linear law to start from, without terms
std::vector<ReferenceTerm> find_feedforward(LoopSignals const& signals, ControllerColumns columns,
                                            SampleRows const& rows);

}  // namespace torquescope
