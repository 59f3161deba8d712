#pragma once
// The diagnosis of an arm, decided on all samples: each joint by the same rules as a joint alone.
//
// Joint      its own friction and inertia, and the columns of the arm's row as far as its own rows tell them; along
//            other directions the masses are those that the other joints' rows tell (all_rows/shared_columns.hpp)
// Pooled     the joints' models fitted once more together, with one set of masses: errors are of it, an effect that
//            does not lower what it leaves on judged rows is refuted, and a joint whose own masses do far better is
//            unexplained
// Chance     alpha over the number of joints (Bonferroni)
// Errors     as diagnose_arm()
// Threads    as diagnose_arm()
// Source     engine/infer/all_rows/THEORY.md, Arms

#include "engine/diagnose/arm_diagnosis.hpp"

namespace torquescope {

Diagnosis diagnose_arm_on_all_rows(ArmDiagnosisInput const& input, StageSink const& progress);

}  // namespace torquescope
