#pragma once
// What a loaded job asks a diagnosis for, in the words of the diagnose layer.
//
// Training   parameters are fitted to the first recording; further ones are predicted, each in its own loop, like those
//            of validation: a law must serve them all
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
  std::vector<Recording> others_;
  DiagnosisInput input_;
};

}  // namespace torquescope
