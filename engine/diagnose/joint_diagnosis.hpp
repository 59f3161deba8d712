#pragma once
// The whole diagnosis of one joint: checks, search, abstention, unseen recordings, verdict.
//
// Verdict    data_fault, insufficient   the recording cannot carry a diagnosis (recording_checks.hpp), the baseline
//            cannot be
//                                       fitted or simulated; what was named fails on unseen recordings only where they
//                                       go beyond the training motion (unseen_range.hpp); or all that is missing is a
//                                       fault of a channel
//            none                       no gate opened (forward_selection.hpp)
//            unexplained                something is missing and nothing fits. Or the named effects are withdrawn: they
//            explain
//                                       less than half of it, in weighed rows and in the torque itself, and the rest is
//                                       beyond chance; or they leave more than 3 % of
//                                       it, far beyond chance, and either the smooth function that holds most of that
//                                       holds more than half and is of an axis which is none of theirs, or they explain
//                                       less than two thirds while a smooth function holds a fifth of what is left; or
//                                       unseen recordings speak against them (unseen_refutation.hpp)
//            named, one_of_class        the rest, less names that spoil unseen recordings (unseen_selection.hpp); a
//            class when another effect fits as well (equivalent_effects.hpp)
// Errors     Error 78 for a filter that does not suit the recording; everything a recording is to blame for is a
//            verdict
// Threads    spreads work over `threads`; same bits for any number
// Source     PHYSICS.md section 2; LESSONS items 9 to 18 of our own prototype

#include <functional>
#include <vector>

#include "engine/search/forward_selection.hpp"
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
  TwinExchange* exchange = nullptr;  // other processes of the same diagnosis; none
};

Diagnosis diagnose_joint(DiagnosisInput const& input, StageSink const& progress);

}  // namespace torquescope
