#pragma once
// The whole diagnosis of one joint: checks, search, adequacy, validation recordings, verdict.
//
// Verdict    engine/infer/moving_rows/THEORY.md, Verdict
// Errors     Error 78 for a filter that does not suit the recording; what a recording is to blame for is a verdict
// Threads    spreads work over `threads`; same bits for any number
// Source     METHOD.md

#include <functional>
#include <string>
#include <vector>

#include "engine/infer/all_rows/loop_stage.hpp"
#include "engine/infer/moving_rows/decision_levels.hpp"
#include "engine/infer/replicates/twin_exchange.hpp"
#include "engine/infer/search/selection.hpp"
#include "engine/infer/verdict/diagnosis.hpp"

namespace torquescope {

struct DiagnosisInput {
  Recording const& train;                  // the first of training: replicates are simulated with its fit
  std::vector<Recording> const& validate;  // all others: further ones of training, then those to predict
  Regressor const& regressor;
  FilterOptions const& filter;
  Section const& filter_section;
  SelectionOptions selection{};
  DecisionLevels levels{};
  std::size_t twins = 200;
  std::uint64_t seed = 0;
  int threads = 1;
  Ablation ablation{};
  ReversalRows reversals = ReversalRows::both;
  int joint = 1;                     // its number
  std::string joint_name{};          // for texts: of the position column
  std::size_t further_training = 0;  // so many of the others
  double parameter_share = 0.0;      // SimulatorGap of an arm, whose recordings are without their simulator by now
  LoopOptions loop{};                // [loop] of the job: what led the recordings
  TwinExchange* exchange = nullptr;  // other processes of the same diagnosis; none
};

// of all recordings that are fitted
std::vector<std::string> training_names(DiagnosisInput const& input);

// torque of an effect, per sample: of the first training recording, then of each other
using LawTorques = std::vector<Eigen::VectorXd>;

struct JointOutcome {
  Diagnosis diagnosis;
  std::vector<LawTorques> laws{};   // of each name, in the order of acceptance
  std::vector<LawTorques> tried{};  // the same of the search, whether or not the verdict keeps names
};

JointOutcome diagnose_joint(DiagnosisInput const& input, StageSink const& progress);

}  // namespace torquescope
