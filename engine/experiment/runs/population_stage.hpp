#pragma once
// All runs of one population method, or a shard's share of them: each from its beginning, or from where segments or an
// earlier result have it.
//
// Bits       a run's history is the same however often it was interrupted
// Threads    commit() by one thread at a time, in the order of the runs, with `hdf5` held
// Errors     75 when a stop was requested: every run under way is with the keeper then

#include <cstddef>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "engine/experiment/experiment_parts.hpp"
#include "engine/experiment/job/stored_generations.hpp"
#include "engine/experiment/progress_update.hpp"
#include "engine/experiment/runs/earlier_result.hpp"
#include "engine/experiment/runs/identify_options.hpp"
#include "engine/experiment/runs/run_keeper.hpp"
#include "engine/experiment/runs/saved_runs.hpp"
#include "engine/fit/problem/squared_error_floor.hpp"

namespace torquescope {

// what one process of a job has: what was done before it, and where it keeps what it does
// what killed processes of this share left: gathered where its lock is ours
enum class LeftSegments { stay, are_gathered };

struct Attempt {
  Attempt(Experiment const& experiment, IdentifyOptions const& options, LeftSegments left);
  Attempt(Attempt const&) = delete;

  IdentifyOptions const& options;
  std::mutex hdf5;  // one thread of the process at a time
  SavedRuns saved;
  EarlierResult earlier;
  RunKeeper keeper;
  std::size_t runs_total = 0, runs_before = 0;  // of population methods, of this shard: all, and those segments have
  std::size_t methods = 0;                      // population methods
  // of every method, on average and rounded up
  std::size_t runs_left() const { return methods > 0 ? (runs_total - runs_before + methods - 1) / methods : 0; }
};

HistoryShape history_shape(Experiment::Parts const& parts, EstimatorPlan const& plan);
// in the result; segments have them all
StoredGenerations stored_generations(Experiment::Parts const& parts, EstimatorPlan const& plan);
// runs of this shard, ascending
std::vector<std::size_t> runs_of_shard(Experiment::Parts const& parts, ShardChoice const& shard);

struct PopulationStage {
  Experiment::Parts const& parts;
  EstimatorPlan const& plan;
  FitnessChoice const& choice;
  SquaredErrorFloor const& floor;
  ProgressSink const& progress;
  Attempt& attempt;
};
using CommitRun = std::function<void(std::size_t run, std::shared_ptr<RunHistory const> const& history)>;
void run_population(PopulationStage const& stage, std::vector<std::size_t> const& runs, CommitRun const& commit);

// writes what the attempt has kept and says how to go on; throws Error 75
[[noreturn]] void stop_and_save(Attempt& attempt);

// "they are of shards 3, 7 of 20: ..."; "" where segments are not of one division of the job
std::string words_of_missing_shards(Experiment::Parts const& parts, SavedRuns const& saved);
// runs of the whole job that no segment has to their end, in words: "fade 3, 7, 11 to 14"; "" when there is none
std::string missing_runs(Experiment::Parts const& parts, SavedRuns const& saved, std::size_t& count);

}  // namespace torquescope
