#pragma once
// Which terms of the reference a controller feeds forward, beside its linear part: friction, gravity.
//
// Search     terms join one at a time: the one of a grid (smooth signs of widths over three decades; spans and leads of
//            a few samples; sine and cosine) that takes most of the residual beside the linear columns; widths are
//            refined
// Stop       when the first term takes less than a tenth of what is left (EMPS has no feedforward: 1 %), or a term is
//            within chance: F-like statistic, effective samples by the residual's memory, against z^2 + 2
//            log(candidates), z = 3.29 (0.1 %)
// Shapes     as controller_regression.hpp; returned terms carry no gain
// Threads    free function
// Source     projection: Golub, Pereyra 1973, doi:10.1137/0710036; friction and gravity fed forward: Siciliano et al.,
//            Robotics (2009) section 8.5, doi:10.1007/978-1-84628-642-1

#include <vector>

#include "engine/simulate/controller_regression.hpp"
#include "engine/simulate/reference_term.hpp"

namespace torquescope {

// columns: the linear controller to start from, without terms
std::vector<ReferenceTerm> find_feedforward(LoopSignals const& signals, ControllerColumns columns,
                                            SampleRows const& rows);

}  // namespace torquescope
