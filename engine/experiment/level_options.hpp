#pragma once
// [diagnose.levels]: the numbers of a decision that no user needs, for ablations.
//
// Threads    plain record

#include <string>
#include <vector>

#include "engine/base/options.hpp"
#include "engine/experiment/diagnose_options.hpp"
#include "engine/infer/decision/decision_numbers.hpp"

namespace torquescope {

struct LevelOptions : DecisionNumbers {
  // in the words of a job file, those that differ from the method: "beam = 1"; empty: it is whole
  std::vector<std::string> changed() const;

  static OptionTable<LevelOptions> const& table();
};

// both sections of the job together
DecisionNumbers decision_numbers(DiagnoseOptions const& options, LevelOptions const& levels);

}  // namespace torquescope
