#pragma once
// Whether the searches of a result can go on under a job: `run --continue`. They can when they would have been the same
// up to there, had the job been theirs from the beginning: the same bits.
//
// Refused    78 for each: settings or recordings that differ in anything but stop rules (which ones, in words); a stop
//            rule stricter than it was, which might have ended a run earlier; other limits for a method that plans by
//            them; fitness made in another way; another program, unless that is allowed; no states to go on from
// Free       names, number of runs, [output], validation recordings, other estimators; wall_clock_s counts anew
// Threads    free functions; reading as HDF5

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "engine/experiment/experiment_parts.hpp"
#include "engine/store/result_reader.hpp"

namespace torquescope {

// what a result says of the searches in it
struct EarlierSearch {
  struct Method {
    std::string fitness_used;
    std::vector<double> start;  // of start_from; else empty
    bool has_populations = false, has_states = false;
    bool is_thinned = false;  // it stores some generations only
  };
  std::filesystem::path file;
  Job job;
  std::vector<std::string> recordings_sha256;  // of training
  std::string robot_sha256;                    // of an arm; else empty
  std::string numerics_sha256;
  std::map<std::string, Method> methods;  // by label
};

// Errors     those of ResultReader; 65 for a result of another kind
EarlierSearch read_earlier_search(ResultReader const& reader);

// empty: they can
std::vector<Problem> reasons_to_begin_anew(EarlierSearch const& earlier, Experiment::Parts const& parts,
                                           bool allow_mixed);

}  // namespace torquescope
