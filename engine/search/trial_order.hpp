#pragma once
// In which order refined candidates are tried, and whether they help where they were not fitted.
//
// Order      most gain first. What acts all the time comes before an event, when it explains half as much on blocks it
//            was not fitted to and no less than the event does there. Within 97 % of the first one's gain: another wave
//            of what is accepted, then fewer parameters (those of a plain form, Effect::has_plain_form, where that
//            does)
// Elsewhere  t >= 2 over blocks, or half of the gain there: what acts in few places gains in few blocks
// Threads    free functions
// Source     METHOD.md, Refinement and choice

#include <limits>
#include <optional>
#include <vector>

#include "engine/search/late_torque.hpp"
#include "engine/search/shape_refinement.hpp"
#include "engine/statistics/blocked_cv.hpp"

namespace torquescope {

struct Trial {
  EffectScan scan;
  double q = 1.0;
  RefinedEffect refined;
  DrivenBy driven_by = DrivenBy::twin;  // whose motion the refined shape was found on (own_motion.hpp)
  std::optional<RefinedEffect> own{};   // on the recorded motion, where `refined` is not
  BlockedGain cv{};
  double most_in_a_block = 0.0;  // of the refined effect's energy
  bool is_named = false;         // already: another wave of it is no new kind of physics
  double region_share =
      std::numeric_limits<double>::quiet_NaN();  // of its gain, where it acts (region_consistency.hpp)
  std::optional<LateTorque> instead{};           // beside the effects accepted before
};

std::vector<Trial> in_order_of_trial(std::vector<Trial> trials);

bool helps_elsewhere(BlockedGain const& cv, double gain);

// Other blocks of time cannot confirm it: it begins at an instant, or it reaches its limit mostly in one
// block, and what is left of it elsewhere does not help. For its refusal; the order above asks for instants alone
bool happens_once(Trial const& trial);

}  // namespace torquescope
