#pragma once
// What a loaded job asks a diagnosis for, in the words of the diagnose layer.
//
// Errors     Error 78 unless the job names one training recording
// Lives      looks into `parts`, which outlive it; stays where it is made

#include <vector>

#include "engine/diagnose/joint_diagnosis.hpp"
#include "engine/run/experiment_parts.hpp"

namespace torquescope {

class JobInput {
 public:
  JobInput(Experiment::Parts const& parts, int threads, TwinExchange* exchange = nullptr);
  JobInput(JobInput const&) = delete;
  JobInput& operator=(JobInput const&) = delete;

  DiagnosisInput const& input() const { return input_; }

 private:
  Section filter_;
  std::vector<Recording> none_{};
  DiagnosisInput input_;
};

}  // namespace torquescope
