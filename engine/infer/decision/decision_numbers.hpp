#pragma once
// Levels and budgets of a decision, with unit, meaning and source. The job sets alpha, delta, least_fall and tolerance
// (diagnose.q and so on). Conventions of rows and filters stand beside their code: strip.cpp, sticking_shape.cpp,
// row_noise.cpp.
//
// Threads    plain record
// Source     engine/infer/decision/THEORY.md, Numbers

#include <cstddef>
#include <cstdint>

namespace torquescope {

struct DecisionNumbers {
  // chance over the whole catalogue (max-T: Westfall, Young 1993, ISBN 978-0-471-55761-6)
  double alpha = 0.05;
  // of adequacy, smooth functions and refused effects: a second question about the same model (Bonferroni)
  double correction_alpha() const { return 0.5 * alpha; }
  // of the torque's rms: the smallest torque of an effect that is worth a name (Lakens 2017,
  // doi:10.1177/1948550617697177)
  double delta = 0.0025;
  // of the error on judged rows: effects that lower it by less are no names
  double least_fall = 0.05;
  // of the torque's rms: a model beside which an effect of this size would not be seen cannot be called complete
  double tolerance = 0.1;
  // of the mismatch: what an effect of several joints must explain, and what a joint may keep from the common masses
  double most_of_it = 0.5;
  // of alpha, what effects of a whole arm may spend; its joints share the rest alike (weighted Bonferroni: Genovese,
  // Roeder, Wasserman 2006, doi:10.1093/biomet/93.3.509)
  double whole_arm_share = 0.1;
  double alpha_of_whole_arm() const { return whole_arm_share * alpha; }
  double alpha_of_joint(std::size_t joints) const {
    return joints > 1 ? (1.0 - whole_arm_share) * alpha / static_cast<double>(joints) : alpha;
  }
  // replicates of a model, and of these above which no name can come out any more (Besag, Clifford 1991,
  // doi:10.1093/biomet/78.2.301)
  std::int64_t replicates = 48, exceedances = 3;
  // squares that a sticking of friction may leave, over those of the best: what replicates draw
  double sticking_odds = 2.0;
  // s: the longest delay of the torque that is a nuisance; beyond it, it is none
  double longest_delay_s = 0.15;
  // candidates of a step whose shapes are refined
  std::int64_t refined = 5;
  // energy by which columns may change from the recording to a replicate and still be computed once for all
  double same_columns = 0.01;
  // models that a ladder follows at once: greedy steps fail on ties (engine/infer/decision/THEORY.md, In the loop)
  std::int64_t beam = 3;
  // of training, which simulations fit; of more, stretches are spread over the time. Errors are of all samples
  std::int64_t fitted_samples = 60000;
  // of the torque's rms: a gain of the position's error that leaves less is what the torque was computed with
  double computed_torque = 0.01;
  // of the torque's rms: an identified controller that leaves more does not lead this loop; no source
  double largest_loop_error = 0.1;
};

}  // namespace torquescope
