#pragma once
// What a ladder asks for: effects that the scan of rows found worth a look, and what may act between command and motor.
//
// Effects    those taken by the scan, with their rivals, then those beyond chance; no effect of a given column, of
//            an instant that the scan did not take, or of the torque's time
// Starts     of an effect: the scan's shape and a coarse grid of its first; of a limit: shares of how fast the joint
//            moves; of a delay: samples and more. Replicates get the same
// Units      SI of the joint's kind
// Threads    pure functions

#include <vector>

#include "engine/infer/decision/decision_facts.hpp"
#include "engine/infer/decision/loop_model.hpp"
#include "engine/simulate/rollout/drive_effect.hpp"

namespace torquescope {

// as one more effect of a simulated joint: not of the model already, no given column, none of an arm or of timing
bool can_be_simulated(Effect const& effect, Regressor const& regressor);

// shape: where it begins; what it leaves open begins at none of it, or in the middle
LoopMove effect_move(Effect const& effect, std::vector<double> const& shape, JointScales const& scales);
std::vector<LoopMove> effect_moves(DecisionFacts const& scan, Regressor const& regressor, JointScales const& scales,
                                   DecisionNumbers const& numbers);

// effects of the drive and the gear whose own number the loop has neither given nor free; none of an identified
// controller
std::vector<LoopMove> drive_moves(LoopSetting const& loop, std::vector<RolloutTrack> const& training,
                                  std::vector<DriveEffect const*> const& effects, bool fits_weight = false);
std::vector<DriveEffect const*> drive_effects_of(DriveEffectKind kind);

}  // namespace torquescope
