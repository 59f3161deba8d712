#pragma once
// The whole diagnosis of one joint: checks, search, adequacy, validation recordings, verdict.
//
// Verdict    engine/inference/THEORY.md, Verdict
// Errors     Error 78 for a filter that does not suit the recording; what a recording is to blame for is a verdict
// Threads    spreads work over `threads`; same bits for any number
// Source     METHOD.md

#include <functional>
#include <string>
#include <vector>

#include "engine/search/selection.hpp"
#include "engine/twin/twin_exchange.hpp"
#include "engine/verdict/diagnosis.hpp"

namespace torquescope {

struct DiagnosisInput {
  Recording const& train;
  std::vector<Recording> const& validate;
  Regressor const& regressor;
  FilterOptions const& filter;
  Section const& filter_section;
  SelectionOptions selection{};
  std::size_t twins = 200;
  std::uint64_t seed = 0;
  int threads = 1;
  Ablation ablation{};
  ReversalRows reversals = ReversalRows::mask;
  std::string joint_name{};          // for texts: of the position column
  TwinExchange* exchange = nullptr;  // other processes of the same diagnosis; none
};

Diagnosis diagnose_joint(DiagnosisInput const& input, StageSink const& progress);

}  // namespace torquescope
