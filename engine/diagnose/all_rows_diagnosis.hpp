#pragma once
// A diagnosis decided on all samples (engine/infer/all_rows), told as every other diagnosis is.
//
// Errors     as diagnose_joint()
// Threads    as diagnose_joint()

#include <functional>
#include <string>
#include <vector>

#include "engine/diagnose/joint_diagnosis.hpp"
#include "engine/infer/all_rows/joint_decision.hpp"

namespace torquescope {

// which decision a job asks for: that on moving rows, that on all, or the first with the other beside it
enum class Decider { by_job, moving_rows, all_rows, both };  // by_job: "auto"
std::vector<std::string> decider_words();                    // of a job file, in that order
Decider decider_of(std::string const& word);

// what else is to be learnt from a decision, while it stands
using DecisionSink = std::function<void(JointDecision const&)>;

JointOutcome diagnose_on_all_rows(DiagnosisInput const& input, StageSink const& progress,
                                  DecisionSink const& further = {});

}  // namespace torquescope
