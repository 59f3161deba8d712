#pragma once
// What a loaded job asks a diagnosis for, in the words of the diagnose layer.
//
// Training   replicates are simulated with the fit of the first recording; one fit to all of them is what is reported
// Lives      looks into `parts`, which outlive it; stays where it is made

#include <vector>

#include "engine/diagnose/arm_diagnosis.hpp"
#include "engine/experiment/experiment_parts.hpp"

namespace torquescope {

class JobInput {
 public:
  JobInput(Experiment::Parts const& parts, int threads);
  JobInput(JobInput const&) = delete;
  JobInput& operator=(JobInput const&) = delete;

  DiagnosisInput const& input() const { return input_; }

 private:
  Section filter_;
  std::vector<Recording> others_;
  DiagnosisInput input_;
};

// the same of an arm; looks into `parts` alone
ArmDiagnosisInput arm_input(Experiment::Parts const& parts, Section const& filter, int threads);

}  // namespace torquescope
