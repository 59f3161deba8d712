#pragma once
// The candidates of a step with their shapes refined, best first.
//
// Shapes     refined on the mismatch by an optimiser of the registry, then polished; of laws with memory also on the
//            recorded motion, which such a law shapes itself. Of all shapes that of the largest gain (Evidence) stands
// Variants   a law without one of its shapes (EffectParameter::none_at_lower) where that leaves no clearly more
// Bounds     a shape at the end of what is plausible is moved a tenth of its range inside where that leaves no clearly
//            more; else the best law lies beyond the bound, and it is none of the catalogue
// Order      by gain; those that leave no clearly more than the best, a law's form apart (Evidence), come by their
//            number of parameters, laws of the motion before those of a clock
// Threads    spreads shapes over `threads`; same bits for any number
// Source     engine/infer/moving_rows/THEORY.md, The search; Diebold, Mariano 1995, doi:10.1080/07350015.1995.10524599

#include <optional>
#include <span>
#include <vector>

#include "engine/infer/moving_rows/candidate_evidence.hpp"
#include "engine/infer/search/reached_bound.hpp"
#include "engine/infer/search/shape_refinement.hpp"

namespace torquescope {

struct RefinedCandidate {
  CandidateEvidence evidence{};  // of the grid; gain, train and unseen: at the refined shape
  RowsLeft left{};
  std::size_t n_parameters = 0;  // of the variant
  std::vector<double> shape{};
  Eigen::VectorXd parameters{};
  DrivenBy driven_by = DrivenBy::twin;
  std::vector<std::vector<double>> other_shapes{};  // that explained nearly as much, to be tried by simulation
  std::optional<ReachedBound> bound{};              // that it clearly prefers
  std::int64_t evaluations = 0;
};

// the bound that a law at this shape stands at and clearly prefers to what is a tenth of the range inside
struct InsideBounds {
  std::vector<double> shape{};  // moved inside where that leaves no clearly more
  std::optional<ReachedBound> bound{};
};
InsideBounds inside_bounds(Evidence const& evidence, Effect const& effect, std::vector<double> shape,
                           Eigen::VectorXd const& linear, FoldKind folds, DrivenBy motion);

struct RefinementSetting {
  std::string optimiser = "de";
  std::uint64_t seed = 0;
  int threads = 1;
  bool everywhere = true;  // shapes of parts that ring or knock over all bounds, where the grid is too coarse
};

RefinedCandidate refined_candidate(Evidence const& evidence, CandidateEvidence const& law,
                                   RefinementSetting const& setting);

// without_any: of the model alone; tolerance: DecisionLevels
std::vector<RefinedCandidate> in_order(std::vector<RefinedCandidate> candidates, RowsLeft const& without_any,
                                       double tolerance);

}  // namespace torquescope
