#pragma once
// What simulations in the loop found out about effects and about what acts between command and motor: numbers and
// enums.
//
// D          sum over channels of n_eff ln(S_0 / S_1): of the fit, or, where none was made, of its first step
// Errors     of a simulation from the reference, over all samples: position as a share of untold_positions(), torque of
//            itself; NaN: the channel does not count, or there is no such recording
// Units      SI of the joint's kind
// Threads    plain records
// Source     engine/infer/decision/THEORY.md, In the loop

#include <cstddef>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "engine/effects/effect.hpp"
#include "engine/simulate/rollout/loop_form.hpp"
#include "engine/simulate/rollout/rollout_residuals.hpp"

namespace torquescope {

// whether simulations decide, and if not, why
enum class LoopReason {
  decides,
  no_reference,      // no recording of training says what was commanded
  no_controller,     // none answers as the recorded torque does
  diverges,          // the model runs away in its loop
  predicts_nothing,  // what is left of a channel is as large as the channel
};

enum class MoveRefusal {
  none,
  chance,         // replicates of the model reach such a gain
  smaller,        // another move of this step gains more
  failed_fit,     // it ends above its parent: the search, not the effect, has failed
  at_bound,       // a number at an end of what it can be
  too_small,      // its number is within what the recording can tell
  not_predicted,  // recordings that no fit has seen are not simulated better
};

struct LoopNumber {
  std::string name, unit;
  double value = 0.0, lower = 0.0, upper = 0.0;  // 95 %; NaN: not known
};

// an effect of the joint, or one of its drive and gear (rollout/drive_effect.hpp)
struct LoopSubject {
  Effect const* effect = nullptr;
  LoopKey key = LoopKey::command_delay_s;  // without an effect: the first of the drive effect

  bool operator==(LoopSubject const&) const = default;
  bool is_of_command() const { return effect == nullptr; }
};
std::string name_of(LoopSubject const& subject);  // "cogging", "goal_speed_limit", "command_delay"

struct LoopErrors {
  static constexpr double none = std::numeric_limits<double>::quiet_NaN();
  double position = none, torque = none;
  // geometric mean of the channels that count
  double both() const;
};

struct MoveFacts {
  LoopSubject subject{};
  double gain = 0.0;             // D
  double p = 1.0;                // chance over all moves
  double level = 0.0;            // D that a share alpha of the replicates reach
  LoopErrors before{}, after{};  // of validation, without it training; after: of a fit
  MoveRefusal refusal = MoveRefusal::chance;
};

// what one model of the beam was asked
struct LoopStepFacts {
  std::vector<LoopSubject> model{};
  std::size_t replicates = 0;
  std::vector<MoveFacts> moves{};  // largest D first
};

struct KeptMove {
  LoopSubject subject{};
  double gain = 0.0;  // D against the final model without it
  double p = 1.0;     // of the step that took it
  std::vector<LoopNumber> numbers{};
  std::vector<LoopSubject> rivals{};  // that stand in its place about as well

  bool is(LoopSubject const& one) const { return subject == one; }
  bool may_be(LoopSubject const& one) const;  // it is, or a rival is
};

struct LoopFacts {
  LoopReason reason = LoopReason::no_reference;
  LoopForm form = LoopForm::identified;
  CountedChannels counts{true, true};
  double loop_error = LoopErrors::none;  // of the controller on the measured positions, first recording
  double fitted_share = 1.0;             // of the training samples; errors are of all
  bool has_validation = false;
  LoopErrors base_train{}, base_validation{}, final_train{}, final_validation{};
  std::vector<LoopStepFacts> steps{};
  std::vector<KeptMove> kept{};
  std::vector<LoopNumber> numbers{};  // of the final model

  bool decides() const { return reason == LoopReason::decides; }
  bool is_kept(LoopSubject const& subject) const;
  bool may_be_kept(LoopSubject const& subject) const;  // or stands in the place of one
  // asked of torque and position, and reached by replicates of every model beside which it was; a position that a stiff
  // loop holds says little of a torque
  bool is_chance(LoopSubject const& subject) const;
};

}  // namespace torquescope
