#pragma once
// What `torquescope replay` does, without a word of terminal: load a job or a result, simulate, write.
//
// Errors     Error with the exit codes of error.hpp; 78 of an arm; 73 where something else stands under the output
// Threads    free functions, called from one thread

#include <filesystem>
#include <string>
#include <vector>

#include "engine/experiment/replay_of_parts.hpp"
#include "engine/workflows/workflows.hpp"

namespace torquescope {

struct ReplayRequest {
  std::filesystem::path source;           // a job, or a result of run or diagnose
  std::filesystem::path job{};            // of a result: where its job stands, so that its paths are found
  std::vector<std::string> recordings{};  // in place of the job's validation
  std::string estimator{};                // of a result with runs: this one alone
  ThreadChoice threads{};
};

// sources: the models to be simulated
Experiment load_for_replay(ReplayRequest const& request, std::vector<ReplaySource>& sources);

// Error 73 where something stands there that is no earlier replay
void refuse_other_output(std::filesystem::path const& output);
// a result with /job, /model, /data and /replay
void write_replay_file(Experiment const& experiment, Replay const& replay, std::filesystem::path const& output,
                       ThreadChoice const& threads);

std::string replay_json(Replay const& replay);
// one table a recording, laid end to end: recording, t_s, and each channel measured and by every model
std::string replay_csv(Replay const& replay);

}  // namespace torquescope
