#pragma once
// One joint of an arm as a diagnosis of its own.
//
// Threads    pure functions

#include <cstddef>

#include "engine/diagnose/arm_diagnosis.hpp"
#include "engine/infer/pipeline/recording_checks.hpp"

namespace torquescope {

// terms of a joint's own equation of motion: inertia and friction
Regressor own_terms(ArmModel const& model, std::size_t joint);

// the joint of an input, where there is nothing to tell but why
Diagnosis hopeless_joint(DiagnosisInput const& input, Hopeless const& why);

}  // namespace torquescope
