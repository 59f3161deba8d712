#pragma once
// The models of a job, a run or a diagnosis as rollouts of a loaded job's recordings.
//
// Threads    free functions; const parts

#include <optional>
#include <string>
#include <vector>

#include "engine/experiment/experiment_parts.hpp"
#include "engine/infer/verdict/diagnosis.hpp"
#include "engine/simulate/rollout/replay.hpp"
#include "engine/simulate/rollout/rollout_model.hpp"

namespace torquescope {

struct ReplaySource {
  std::string name;  // "as identified"
  RolloutModel model;
  Eigen::VectorXd parameters;
};

// the job's own numbers: given where it gives them all, else least squares; effects need values of their own.
// Errors     Error 78 where [[model.effects]] have none
std::vector<ReplaySource> sources_of_job(Experiment::Parts const& parts, RolloutParts const& rollout);
// before and after what was named; one where nothing was
std::vector<ReplaySource> sources_of_diagnosis(Experiment::Parts const& parts, RolloutParts const& rollout,
                                               Diagnosis const& diagnosis);
// names: of the parameters as the result has them; one without a number of a parameter of the job is left out
void add_source_of_run(Experiment::Parts const& parts, RolloutParts const& rollout, std::string const& label,
                       std::vector<std::string> const& names, std::vector<double> const& parameters,
                       std::vector<ReplaySource>& sources);

Replay replay_of(Experiment::Parts const& parts, RolloutParts const& rollout, std::vector<ReplaySource> const& sources,
                 int threads);
// of a job that was loaded for a diagnosis; nothing of an arm, or where no joint was identified that could be simulated
std::optional<Replay> replay_of_diagnosis(Experiment::Parts const& parts, Diagnosis const& diagnosis, int threads);

}  // namespace torquescope
