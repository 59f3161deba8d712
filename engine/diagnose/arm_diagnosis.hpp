#pragma once
// The diagnosis of an arm: each joint's equation of motion searched for what it lacks, beside one rigid arm for all.
//
// Steps      fit of the rigid arm and its frictions to all training recordings; of each joint what that arm does not
//            need, with its own friction and inertia free (rigid_rows.hpp); search and verdict of each joint
// Training   a joint's own parameters are of one fit to all training recordings; an effect must serve them all
// Errors     Error 65, 78 as the parts; what a joint's rows are to blame for is that joint's verdict
// Threads    spreads work over `threads`; same bits for any number
// Source     METHOD.md, Arms

#include <vector>

#include "engine/diagnose/joint_diagnosis.hpp"
#include "engine/fit/problem/arm_model.hpp"
#include "engine/fit/problem/recorded_arm.hpp"

namespace torquescope {

// what all joints share is asked as of a joint (DiagnosisInput)
struct ArmDiagnosisInput {
  ArmModel const& model;
  std::vector<RecordedArm> const& train;
  std::vector<RecordedArm> const& validate;
  std::vector<std::vector<Effect const*>> const& candidates;  // [N]
  FilterOptions const& filter;
  Section const& filter_section;
  SelectionOptions selection{};  // but for its candidates
  DecisionLevels levels{};
  std::size_t twins = 200;
  std::uint64_t seed = 0;
  int threads = 1;
  Ablation ablation{};
  ReversalRows reversals = ReversalRows::both;
  TwinExchange* exchange = nullptr;
};

Diagnosis diagnose_arm(ArmDiagnosisInput const& input, StageSink const& progress);

}  // namespace torquescope
