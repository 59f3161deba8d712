#pragma once
// Whether the accepted effects are adequate: what they leave is compared with smooth functions of anything.
//
// Rule       METHOD.md, Adequacy of the final model: a remainder of 3 % with z above 5 and a generic axis that holds
//            half of it, or a fifth where less than two thirds are explained; or less than half explained and the rest
//            beyond z = 3, in weighted rows and in the torque itself
// Threads    free function
// Source     METHOD.md, Adequacy of the final model

#include <string>
#include <vector>

#include "engine/search/forward_selection.hpp"
#include "engine/search/generic_axes.hpp"
#include "engine/verdict/diagnosis.hpp"

namespace torquescope {

struct Remainder {
  double share = 0.0;  // of the first excess that the final model leaves
  bool is_significant = false;
  std::vector<GenericAxis> axes{};  // of what is left, strongest first; empty when nothing is
  bool is_named_enough = true;      // effects explain two thirds, or what they leave may be chance (z below 3)
  bool is_unexplained = false;
  bool is_most_left = false;  // the reason for that: the accepted effects explain less than half
};

// selection: with its baseline
Remainder judge_remainder(Selection const& selection, ModelStage const& final);

// Where unexplained torque is: of the regions of a map the five with most information, first the one whose share of the
// energy is most surprising for its share of the time (the scan statistic of Kulldorff 1997); of spectra the stretch
// that is so for its width and its share of the torque
std::vector<UnexplainedPart> largest_parts(std::vector<MapAxis> const& map);

}  // namespace torquescope
