#pragma once
// Which share of the runs is this process's: what the user says, else what the batch system says of its place.
//
// Order      --shard I/N; a Slurm array (SLURM_ARRAY_TASK_ID, _MIN, _COUNT, _STEP), each of its tasks again divided
//            when srun started several (SLURM_PROCID, SLURM_STEP_NUM_TASKS); srun alone; Open MPI
//            (OMPI_COMM_WORLD_RANK, _SIZE)
// Errors     64: not I/N with 0 <= I < N; an array with gaps, whose tasks cannot be numbered
// Threads    reads the environment through `variable`, no state

#include <functional>
#include <string>

#include "engine/store/segment_folder.hpp"

namespace torquescope {

using ReadVariable = std::function<std::string(char const* name)>;

// given: "" when there is no --shard
ShardChoice choose_shard(std::string const& given, ReadVariable const& variable);

// "0/4", "3/10": why CLI11 must refuse the text; empty: it need not
std::string no_shard(std::string const& text);

}  // namespace torquescope
