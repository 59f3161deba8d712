#pragma once
// Which laws of the whole arm its model lacks: one after the other, judged on the rows of all joints at once.
//
// Accepted   as WholeArmReason says; the error on rows left out must fall clearly (held_out_gain.hpp), at one joint at
//            least by as much as a joint's own name asks for, and more of the mismatch be explained than is left
//            (decision_levels.hpp)
// Mismatch   energy left on rows left out, less that of noise (whole_arm_energies.hpp). Of a law with instants: in its
//            recording
// Alike      other laws beyond chance that leave not clearly more on rows left out
// Unseen     a law with instants has instants of its own in each unseen recording, where they explain more than those
//            of replicates (own_instants.hpp); else it does not act there
// Errors     those of the filters
// Threads    spreads the scan over `threads`; same bits for any number

#include <cstdint>
#include <span>
#include <vector>

#include "engine/diagnose/arms/rigid_rows.hpp"
#include "engine/diagnose/arms/whole_arm_fit.hpp"
#include "engine/fit/statistics/held_out_gain.hpp"
#include "engine/infer/moving_rows/decision_levels.hpp"

namespace torquescope {

enum class WholeArmReason {
  accepted,
  chance,         // over all laws and windows more than alpha (whole_arm_scan.hpp)
  out_of_bounds,  // of a parameter
  not_held_out,   // the error on rows left out is not clearly lower
  too_small,      // it falls by less than least_fall at every joint
  most_is_left,   // of the mismatch
  unseen          // unseen recordings that it acts in are predicted worse
};

struct FoundWholeArmLaw {
  LawPlace law{};
  std::optional<ActingTime> time{};
  Eigen::VectorXd values{}, errors{};  // as WholeArmFit
  std::vector<bool> is_told{};
  double z = 0.0, p = 1.0;
  double explained = 0.0;            // share of the mismatch, on rows left out
  Eigen::VectorXd explained_at{};    // [N] the same of each joint
  double before = 0.0, after = 0.0;  // relerr over all joints on rows left out, of the recordings it may act in
  double unseen_before = 0.0, unseen_after = 0.0;         // the same of unseen recordings it acts in; 0: none
  std::vector<std::optional<ActingTime>> unseen_times{};  // of each unseen recording; none: it does not act there
  WholeArmReason reason = WholeArmReason::chance;
  std::vector<Effect const*> alike{};
};

struct WholeArmQuestion {
  ArmModel const& model;
  std::span<RecordedArm const> train;
  std::span<RecordedArm const> unseen;
  ArmFilter const& filter;
  std::span<Effect const* const> wanted;
  DecisionLevels levels{};
  double alpha = 0.05;
  std::uint64_t seed = 0;
  int threads = 1;
};

struct WholeArmAnswer {
  std::vector<FoundWholeArmLaw> accepted{};
  std::vector<FoundWholeArmLaw> tried{};  // of each law its best window beside the model alone, strongest first
};

// wanted: only laws of the whole arm are looked at; none of them: an empty answer
WholeArmAnswer search_whole_arm(WholeArmQuestion const& question);

// of accepted laws, what each joint needs in addition, n samples at the full rate. is_unseen: `which` counts those
struct OneRecording {
  RecordedArm const& recording;
  std::size_t which = 0;
  bool is_unseen = false;
};
std::vector<Eigen::VectorXd> whole_arm_torques(WholeArmQuestion const& question,
                                               std::vector<FoundWholeArmLaw> const& accepted, OneRecording const& of);

}  // namespace torquescope
