#pragma once
// The shape of a law on the recorded motion, where candidate_columns.hpp uses that of a replicate without the law.
//
// Why        a load that rings behind a spring, or knocks behind a gap, changes the motion that drives it; the recorded
//            motion has that, and encoder noise, which biases a shape a little: good for replicates, no statistic
// Threads    spreads grid and populations over `threads`; same bits for any number

#include <cstdint>
#include <optional>
#include <string>

#include "engine/infer/search/model_stage.hpp"
#include "engine/infer/search/shape_refinement.hpp"

namespace torquescope {

struct BothMotions {
  CandidateColumns twin, recording;
  explicit BothMotions(ModelStage const& stage, std::size_t without = CandidateColumns::none);
  CandidateColumns const& of(DrivenBy motion) const { return motion == DrivenBy::twin ? twin : recording; }
};

// The searches of one effect, each made once: that of the whole bounds begins with what is next to the grid's best
// point
class OwnMotionShapes {
 public:
  // own: columns on the recording's motion; scan: of the effect, with its grid; all of them outlive this
  OwnMotionShapes(CandidateColumns const& own, EffectScan const& scan, Eigen::VectorXd const& mismatch,
                  std::string optimiser, std::uint64_t seed, int threads);

  // nothing for an effect without memory, or one that explains nothing there
  std::optional<RefinedEffect> const& nearby();
  // Not next to the grid's best point alone: what rings has a maximum of its own for every cycle that two shapes have
  // in common, and the grid is too coarse to tell which is the highest. Eight members a shape: of six seeds, three to
  // six found the shape of a gap with 20 members, five or six with 40. Counts the evaluations of nearby() as well
  std::optional<RefinedEffect> everywhere();

 private:
  ShapeSearch longer_search() const;

  CandidateColumns const& own_;
  EffectScan const& scan_;
  Eigen::VectorXd const& mismatch_;
  std::string optimiser_;
  std::uint64_t seed_;
  int threads_;
  bool is_made_ = false;
  std::optional<std::size_t> point_{};
  std::optional<RefinedEffect> nearby_{};
};

}  // namespace torquescope
