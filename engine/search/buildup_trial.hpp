#pragma once
// Friction that builds up after reversals as a candidate for a name, along one of two motions (friction_buildup.hpp).
//
// Common     the motion and the mismatch of the search. Within a tick of the encoder that motion is not the one
//            friction made
// Own        the recording's motion and its residual: where the joint creeps and its twins stick, theirs is another
//            motion, and what sticking leaves in their residual is none of the recording's
// Nuisance   sign(dq) smeared over a speed, at five speeds from 1/2000 to 1/25 of the peak
// Answer     the one of the two laws that explains more; the simpler where it explains half as much. None unless it
//            explains more than any other effect, a quarter of what is left beside the nuisance, helps on other blocks,
//            is plausible, and q is at the level
// Others     at the shapes that explain most along the common motion: nobody looks for theirs along the recording's,
//            twins judge in the end
// Shapes     q: one per scan
// Units      gains are energies of the rows, (N m)^2 or N^2
// Threads    free functions, which use those of the look

#include <optional>
#include <string>
#include <vector>

#include "engine/search/model_stage.hpp"
#include "engine/search/trial_order.hpp"

namespace torquescope {

// remembers where it turned, and nothing else
bool is_buildup(Effect const& effect);

// on rows with reversals, beside what is named
struct BuildupLook {
  ModelStage const& rows;
  BaselineReference reference;
  Eigen::VectorXd const& parameters;  // of the model without the candidate
  double q = 0.05;
  std::string shape_optimiser = "de";
  std::uint64_t seed = 0;
  int threads = 1;
};

// columns along that motion, with the nuisance among what candidates must explain something beside
CandidateColumns buildup_columns(BuildupLook const& look, DrivenBy driven_by);

// scans: on the common motion; q: theirs. evaluations: of the search for shapes, added to
std::optional<Trial> buildup_trial(BuildupLook const& look, DrivenBy driven_by, std::vector<EffectScan> const& scans,
                                   std::vector<double> const& q, std::int64_t& evaluations);

}  // namespace torquescope
