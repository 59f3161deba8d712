#pragma once
// Where unexplained torque is: of the regions of a map those with most information.
//
// Rule       five at most, first the one whose share of the energy is most surprising for its share of the time; of a
//            spectrum the stretch that is so for its width and for its share of the torque
// Threads    pure function
// Source     scan statistic: Kulldorff 1997, doi:10.1080/03610929708831995

#include <vector>

#include "engine/infer/verdict/diagnosis.hpp"

namespace torquescope {

std::vector<UnexplainedPart> largest_parts(std::vector<MapAxis> const& map);

}  // namespace torquescope
