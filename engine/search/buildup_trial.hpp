#pragma once
// Friction that builds up after reversals as a candidate, along one of two motions (friction_buildup.hpp).
//
// Common     the noise-free motion and the mismatch of the search. Within an encoder step it differs from the real one
// Own        the recorded motion and its residual: where the joint creeps and its replicates stick, theirs is another
// Nuisance   sign(dq) smeared over a speed, at five speeds from 1/2000 to 1/25 of the peak
// Answer     the law of the two that explains more, the simpler one from half as much; none unless it explains more
//            than any other effect and a quarter of what is left, helps on other blocks, is plausible, and q is at the
//            level
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

// on rows with reversals, beside the accepted effects
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
