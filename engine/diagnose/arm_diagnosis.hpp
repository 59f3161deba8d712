#pragma once
// The diagnosis of an arm: what several joints feel at once, then each joint by the same rules as a joint alone.
//
// Joint      its own friction and inertia, and the columns of the arm's row as far as its own rows tell them; along
//            other directions the masses are those that the other joints' rows tell (decision/shared_columns.hpp)
// Pooled     the joints' models fitted once more together, with one set of masses: errors are of it, an effect that
//            does not lower what it leaves on judged rows is refuted, and a joint whose own masses do far better is
//            unexplained
// Chance     alpha over the whole arm and its joints (DecisionNumbers::alpha_of_joint)
// Errors     Error 65, 78 as the parts; what a joint's rows are to blame for is that joint's verdict
// Threads    spreads work over `threads`; same bits for any number
// Source     engine/infer/decision/THEORY.md, Arms

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
  std::size_t max_effects = 5;
  DecisionNumbers numbers{};
  std::uint64_t seed = 0;
  int threads = 1;
};

Diagnosis diagnose_arm(ArmDiagnosisInput const& input, StageSink const& progress);

}  // namespace torquescope
