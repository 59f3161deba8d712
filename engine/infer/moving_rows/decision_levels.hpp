#pragma once
// Every number between rows and verdict, with its meaning and source; the ten folds are n_folds of equal_blocks.hpp.
//
// Options    the job sets alpha (diagnose.q), delta, tolerance, least_fall (diagnose.delta and so on), replicates
//            (diagnose.twins) and steps (diagnose.max_effects); the rest are budgets and conventions
// Threads    constants

#include <cstddef>

namespace torquescope {

struct DecisionLevels {
  // of chance, over the whole catalogue (max-T: Westfall, Young 1993, ISBN 978-0-471-55761-6)
  double alpha = 0.05;
  // the engineer's tolerance: a model that leaves less beyond chance, as a share of the torque's rms, is adequate
  double delta = 0.0025;
  // how far the form of a law may be off, as a share of its own torque, and the model still be adequate
  double tolerance = 0.1;
  // the least fall of the held-out error that a verdict names, as a share of it: the smallest effect of interest
  // (Lakens 2017, doi:10.1177/1948550617697177)
  double least_fall = 0.05;
};

// of alpha, what laws of a whole arm may spend; its joints share the rest alike (weighted Bonferroni: Genovese, Roeder,
// Wasserman 2006, doi:10.1093/biomet/93.3.509)
inline constexpr double whole_arm_share = 0.1;
constexpr double level_of_joint(double alpha, std::size_t joints) {
  return joints > 1 ? (1.0 - whole_arm_share) * alpha / static_cast<double>(joints) : alpha;
}
// laws of a model that is not adequate are named when they explain more of the mismatch than they leave
inline constexpr double most_of_it = 0.5;
// of adequacy: training rows weighed, in the torque itself, and unseen (Bonferroni)
inline constexpr double questions_of_adequacy = 3.0;
// budget: candidates whose shape is refined at a step
inline constexpr std::size_t n_refined = 6;
// budget: of these, candidates that are simulated until one is taken
inline constexpr std::size_t n_simulated = 3;

}  // namespace torquescope
