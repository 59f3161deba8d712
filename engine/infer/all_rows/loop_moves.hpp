#pragma once
// What a ladder asks for: laws that the scan of rows found worth a look, and what may act between command and motor.
//
// Laws       those taken by the scan, with their rivals, then those beyond chance; no law of a given column, of an
//            instant that the scan did not take, or of the torque's time
// Starts     of a law: the scan's shape and a coarse grid of its first; of a limit: shares of how fast the joint moves;
//            of a delay: samples and more. Replicates get the same
// Units      SI of the joint's kind
// Threads    pure functions

#include <vector>

#include "engine/infer/all_rows/decision_facts.hpp"
#include "engine/infer/all_rows/loop_model.hpp"
#include "engine/simulate/rollout/drive_law.hpp"

namespace torquescope {

// shape: where it begins; what it leaves open begins at none of it, or in the middle
// as one more effect of a simulated joint: not of the model already, no given column, none of an arm or of timing
bool can_be_simulated(Effect const& law, Regressor const& regressor);

LoopMove law_move(Effect const& law, std::vector<double> const& shape, JointScales const& scales);
std::vector<LoopMove> law_moves(DecisionFacts const& scan, Regressor const& regressor, JointScales const& scales,
                                DecisionNumbers const& numbers);

// laws of the drive and the gear whose own number the loop has neither given nor free; none of an identified law
std::vector<LoopMove> drive_moves(LoopSetting const& loop, std::vector<RolloutTrack> const& training,
                                  std::vector<DriveLaw const*> const& laws, bool fits_weight = false);
std::vector<DriveLaw const*> drive_laws_of(DriveLawKind kind);

}  // namespace torquescope
