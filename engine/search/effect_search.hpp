#pragma once
// One line of the forward search: a stage, what was accepted on the way to it, and the next round. Conditions of a
// round: METHOD.md, The search. A copy is cheap (stages are shared) and continues by itself.
//
// Threads    as the stages; a line is used by one thread
// Errors     Error 65 from the constructor: the baseline cannot be fitted, or its replicates do not follow the
//            reference

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "engine/search/forward_selection.hpp"
#include "engine/search/own_motion.hpp"
#include "engine/search/trial_order.hpp"
#include "engine/statistics/region_consistency.hpp"

namespace torquescope {

class EffectSearch;

inline constexpr double least_share_of_rest = 0.25;  // that an effect must explain, of what a round looks for

// of which rows weighted by the friction random walk keep little
inline bool is_drift_of_friction(Effect const& effect) {
  return effect.is_dry_friction() && effect.family() == EffectFamily::time;
}

struct Round {
  bool is_taken = false;
  bool began_again = false;  // among replicates with the largest friction random walk, with nothing accepted
  // Nine tenths as good as what was taken, and refused by nothing but the order; not what happens once, nor a change
  // over time
  std::vector<Trial> nearly_taken{};
  std::shared_ptr<EffectSearch const> before{};  // the line when all had been searched and nothing taken
};

class EffectSearch {
 public:
  // makes the stage without effects
  EffectSearch(StageSetting const& setting, SelectionOptions const& options, StageSink const& progress);

  Round next_round();
  // takes an effect that a copy of this line nearly took; false when twins refuse it
  bool take(Trial const& trial);

  Selection const& selection() const { return selection_; }
  StageSetting const& setting() const { return setting_; }
  ModelStage const& stage() const { return *selection_.final; }
  // of the whole, beyond noise
  double left_share() const;
  // a line that began at another one's fork does not begin again
  void do_not_begin_again() { may_begin_again_ = false; }
  void note_refusal(Effect const* effect, std::string reason) {
    selection_.rejected.push_back({effect, std::move(reason)});
  }

 private:
  bool begin(StageSetting const& setting);
  bool begin_somehow();
  void tell(char const* what, std::size_t done, std::size_t total) const;
  bool opens(CandidateColumns const& columns, std::vector<EffectScan> const& scans, std::vector<double> const& q);
  double largest_certain_share(CandidateColumns const& columns, std::vector<EffectScan> const& scans,
                               std::vector<double> const& q) const;
  double largest_drift_share(CandidateColumns const& columns, std::vector<EffectScan> const& scans,
                             std::vector<double> const& q) const;
  std::vector<Trial> refined_trials(BothMotions const& columns, std::vector<EffectScan> const& scans,
                                    std::vector<double> const& q);
  void prefer_own_motion(CandidateColumns const& own, Trial& trial);
  std::optional<ModelStage> draft_of(Trial const& trial) const;
  bool is_taken(Effect const* effect) const;
  bool begin_again_with_wander();

  // trial_refusal.cpp: why the projection speaks against it; measures the trial's region
  std::optional<std::string> refusal(CandidateColumns const& columns, Trial& trial) const;
  bool may_be_another_loop(Effect const& effect, double gain, Eigen::VectorXd const& parameters) const;
  bool is_large_in_torque_itself(CandidateColumns const& columns, RefinedEffect const& refined) const;
  RegionConsistency region_of(CandidateColumns const& columns, RefinedEffect const& refined) const;

  StageSetting setting_;
  SelectionOptions const* options_;
  StageSink const* progress_;
  Selection selection_{};
  double remaining_ = 0.0;  // energy that this round looks for
  bool is_faint_ = false;   // this round's gate is open for a candidate's certainty, not for its size
  bool may_begin_again_ = true;
};

}  // namespace torquescope
