#pragma once
// Which effects of drive and gear many recordings of position-controlled servos need: one fit of all, and the ladder.
//
// Loop       P on the goal, by the gain and limit that each recording knows; motor_gain and back_emf are fitted
// Base       the regressor's terms beside the known loads; no recording has numbers of its own, so that one load says
//            something of another
// Scale      where no load is known, all torques are in units of the command and motor_gain is 1
// Errors     of the position, over all samples of all recordings: mean absolute, rad
// Units      SI
// Threads    spreads over the question's threads; same bits for any number of them
// Source     engine/infer/decision/THEORY.md, In the loop; many loads: Duclusaud, Passault, Padois, Ly 2025,
//            arXiv:2410.08650

#include <cstdint>
#include <functional>
#include <vector>

#include "engine/infer/decision/loop_ladder.hpp"
#include "engine/simulate/rollout/drive_effect.hpp"

namespace torquescope {

enum class DriveCommand { voltage, current, position_servo };

// what may be missing
struct ServoEffects {
  std::vector<DriveEffect const*> of_drive{};  // and of the gear
  std::vector<Effect const*> of_joint{};
};

struct ServoQuestion {
  Regressor const& regressor;
  LoopSetting loop{};  // form p
  DriveCommand command = DriveCommand::voltage;
  std::vector<RolloutTrack> const& training;
  std::vector<RolloutTrack> const& validation;
  ServoEffects effects{};
  std::size_t most_effects = 8;
  DecisionNumbers numbers{};
  std::uint64_t seed = 0;
  int threads = 1;
  std::function<void(char const* stage, std::size_t done, std::size_t total)> progress{};
};

struct ServoDecision {
  LoopFacts facts{};
  LoopFit base{}, final{};
  JointScales scales{};
  bool fixes_scale = false;  // N m are N m; else units of the command
  DriveScales recorded{};

  // what a replay is given; model: of one fit
  RolloutModel model(ServoQuestion const& question, LoopFit const& fit) const;
};

// where every fit of these recordings begins
struct ServoBase {
  Eigen::VectorXd terms;
  LoopSetting loop{};  // motor_gain and back_emf are free where they can be told and the job does not give them
  JointScales scales{};
  DriveScales recorded{};
  bool fixes_scale = false;
};
ServoBase servo_base(ServoQuestion const& question);

ServoDecision decide_servo(ServoQuestion const& question);
// parameters of one of its fits, with their intervals
std::vector<LoopNumber> numbers_of_fit(ServoQuestion const& question, ServoDecision const& decision,
                                       LoopFit const& fit);

// one fit of the same structure on other recordings, from where the first came to rest
LoopFit refitted(ServoQuestion const& question, ServoDecision const& decision, LoopFit const& structure);

}  // namespace torquescope
