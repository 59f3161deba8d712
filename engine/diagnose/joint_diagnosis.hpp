#pragma once
// The whole diagnosis of one joint, decided on all samples and told as people read it.
//
// Verdict    engine/infer/decision/THEORY.md, Adequacy
// Errors     Error 78 for a filter that does not suit the recording; what a recording is to blame for is a verdict
// Threads    spreads work over `threads`; same bits for any number
// Source     METHOD.md

#include <functional>
#include <string>
#include <vector>

#include "engine/infer/decision/joint_decision.hpp"
#include "engine/infer/decision/loop_stage.hpp"
#include "engine/infer/verdict/diagnosis.hpp"

namespace torquescope {

struct DiagnosisInput {
  Recording const& train;                  // the first of training: replicates are simulated with its fit
  std::vector<Recording> const& validate;  // all others: further ones of training, then those to predict
  Regressor const& regressor;
  FilterOptions const& filter;
  Section const& filter_section;
  std::vector<Effect const*> candidates{};
  std::size_t max_effects = 5;
  DecisionNumbers numbers{};
  std::uint64_t seed = 0;
  int threads = 1;
  int joint = 1;                     // its number
  std::string joint_name{};          // for texts: of the position column
  std::size_t further_training = 0;  // so many of the others
  double parameter_share = 0.0;      // SimulatorGap of an arm, whose recordings are without their simulator by now
  LoopOptions loop{};                // [loop] of the job: what led the recordings
};

// of all recordings that are fitted
std::vector<std::string> training_names(DiagnosisInput const& input);

// called before and after every piece of work: "replicates" (how many of how many), "search" (effects)
using StageSink = std::function<void(std::string const& stage, std::size_t done, std::size_t total)>;

// what else is to be learnt from a decision, while it stands
using DecisionSink = std::function<void(JointDecision const&)>;

Diagnosis diagnose_joint(DiagnosisInput const& input, StageSink const& progress, DecisionSink const& further = {});

}  // namespace torquescope
