#pragma once
// In which order candidates with a refined shape are tried for a name, and whether they help where they were not
// fitted.
//
// Order      most gain first. Something that acts all the time and explains, on blocks it was not fitted to, half as
//            much and no less than what happens once does there comes before that, for it fits any one peak. Among
//            those that give 97 % of the first one's gain, another wave of what is named already first, then fewer
//            parameters, those of a law's plain form (Effect::has_plain_form) where that gives as much
// Elsewhere  t >= 2 over blocks, or half of the gain there: an effect that acts in few places gains in few blocks, so
//            that its spread says nothing
// Threads    free functions
// Source     LESSONS items 9, 11 and 17 of our own prototype

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
  std::optional<RefinedEffect> own{};   // on the recording's own motion, where `refined` is not that
  BlockedGain cv{};
  double most_in_a_block = 0.0;  // of the refined effect's energy
  bool is_named = false;         // already: another wave of it is no new kind of physics
  double region_share =
      std::numeric_limits<double>::quiet_NaN();  // of its gain, where it acts (region_consistency.hpp)
  std::optional<LateTorque> instead{};           // beside the effects named before
};

std::vector<Trial> in_order_of_trial(std::vector<Trial> trials);

bool helps_elsewhere(BlockedGain const& cv, double gain);

// Nothing in other blocks of time can speak for it: it begins at an instant, or it reaches its limit mostly in one
// block, and what is left of it elsewhere does not help. For its refusal; the order above asks for instants alone
bool happens_once(Trial const& trial);

}  // namespace torquescope
