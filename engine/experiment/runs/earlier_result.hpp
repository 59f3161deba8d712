#pragma once
// A result whose searches go on: `run --continue`. Each run begins behind the generation of its last state, with the
// history up to there.
//
// Trust      all of the file is read and compared with its digest, in a child process first
// Errors     78 with every reason why they cannot go on (earlier_search.hpp); 65, 66, 74 of ResultReader
// Threads    as HDF5: one of the process at a time

#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "engine/experiment/experiment_parts.hpp"
#include "engine/experiment/runs/run_part.hpp"
#include "engine/store/result_reader.hpp"

namespace torquescope {

class EarlierResult {
 public:
  EarlierResult() = default;  // none: no run goes on
  EarlierResult(std::filesystem::path const& file, Experiment::Parts const& parts, bool allow_mixed);

  bool empty() const { return states_.empty(); }
  // nothing where it has no such run, or no state of it: that run begins anew
  std::optional<RunPart> load(std::string const& label, HistoryShape const& shape, std::size_t run) const;

  // one for each method of the job: how many of its runs go on, and from where
  std::vector<std::string> lines() const { return lines_; }
  std::string content_sha256() const { return reader_ ? reader_->content_sha256() : std::string(); }

 private:
  std::unique_ptr<ResultReader const> reader_;
  std::map<std::string, std::vector<OptimiserState>> states_;  // by label and run, without populations
  std::vector<std::string> lines_;
};

}  // namespace torquescope
