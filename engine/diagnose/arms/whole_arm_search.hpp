#pragma once
// Which effects of the whole arm its model lacks: one after the other, judged on the rows of all joints at once.
//
// Accepted   as WholeArmReason says; the error on rows left out must fall clearly (held_out_gain.hpp), at one joint at
//            least by as much as a joint's own name asks for, and more of the mismatch be explained than is left
//            (decision_numbers.hpp)
// Mismatch   energy left on rows left out, less that of noise (whole_arm_energies.hpp). Of an effect with instants: in
//            its recording
// Alike      other effects beyond chance that leave not clearly more on rows left out
// Validation an effect with instants has instants of its own in each validation recording, where they explain more than
//            those of replicates (own_instants.hpp); else it does not act there
// Threads    spreads the scan over `threads`; same bits for any number

#include <cstdint>
#include <span>
#include <vector>

#include "engine/diagnose/arms/whole_arm_fit.hpp"
#include "engine/fit/statistics/held_out_gain.hpp"
#include "engine/infer/decision/decision_numbers.hpp"

namespace torquescope {

enum class WholeArmReason {
  accepted,
  chance,         // over all effects and windows more than alpha (whole_arm_scan.hpp)
  out_of_bounds,  // of a parameter
  not_held_out,   // the error on rows left out is not clearly lower
  too_small,      // it falls by less than least_fall at every joint
  most_is_left,   // of the mismatch
  validation      // validation recordings that it acts in are predicted worse
};

struct FoundWholeArmEffect {
  EffectPlace effect{};
  std::optional<ActingTime> time{};
  Eigen::VectorXd values{}, errors{};  // as WholeArmFit
  std::vector<bool> is_told{};
  double z = 0.0, p = 1.0;
  double explained = 0.0;            // share of the mismatch, on rows left out
  Eigen::VectorXd explained_at{};    // [N] the same of each joint
  double before = 0.0, after = 0.0;  // relerr over all joints on rows left out, of the recordings it may act in
  double validation_before = 0.0, validation_after = 0.0;  // the same of validation recordings it acts in; 0: none
  std::vector<std::optional<ActingTime>>
      validation_times{};  // of each validation recording; none: it does not act there
  WholeArmReason reason = WholeArmReason::chance;
  std::vector<Effect const*> alike{};
};

struct WholeArmQuestion {
  WholeArmRows const& train;
  std::span<WholeArmRows const> validation;  // of each recording
  Eigen::VectorXd const& noise;              // [N]
  DecisionNumbers numbers{};                 // alpha: of the whole arm
  std::uint64_t seed = 0;
  int threads = 1;
};

struct WholeArmAnswer {
  std::vector<FoundWholeArmEffect> accepted{};
  std::vector<FoundWholeArmEffect> tried{};  // of each effect its best window beside the model alone, strongest first
};

WholeArmAnswer search_whole_arm(WholeArmQuestion const& question);

// Of accepted effects, what each joint needs in addition in one recording, n samples at the full rate. effects: of that
// recording; is_validation: `which` counts those; time_s: n, on the recording's own clock
struct OneRecording {
  std::vector<WholeArmEffect> const& effects;
  Eigen::VectorXd const& time_s;
  std::size_t which = 0;
  bool is_validation = false;
};
std::vector<Eigen::VectorXd> whole_arm_torques(std::vector<FoundWholeArmEffect> const& accepted,
                                               OneRecording const& of);

}  // namespace torquescope
