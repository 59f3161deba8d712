#pragma once
// Histories with those generations alone that a result stores ([output] history). Segments keep every generation: what
// a run goes on from, and what two of them are compared by.
//
// Requires   whole histories: of every generation that a run may have
// Threads    free functions

#include "engine/experiment/job/stored_generations.hpp"
#include "engine/experiment/runs/run_history.hpp"
#include "engine/experiment/runs/run_part.hpp"
#include "engine/experiment/runs/segment_file.hpp"

namespace torquescope {

// their lists; the rest stays empty
RunHistory thinned(RunHistory const& history, HistoryShape const& shape, StoredGenerations const& stored);
// of runs that went to the job's last generation
StoredRuns thinned(StoredRuns const& runs, HistoryShape const& shape, StoredGenerations const& stored);

}  // namespace torquescope
