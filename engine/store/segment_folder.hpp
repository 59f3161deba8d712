#pragma once
// The folder RESULT.parts, where a long job leaves its segments until the result file is whole: names, listing,
// removal.
//
// Names      shard-<I>-of-<N>.<host>.<pid>.<began>.<number>.h5: one name per attempt and segment, so that no two
//            processes ever write the same file, whatever else runs (an orphan of a dead Slurm daemon, the same command
//            twice)
// Segments   complete HDF5 files written by ResultWriter: temp file, fsync, rename, fsync of the folder. Never changed.
// Trust      the folder is ours, or refused (own_folder.hpp); a file in it is removed when it says that it is of this
//            job (file_seal.hpp), never because of its name
// Errors     74 when the folder cannot be made or listed; 73 when it is refused; removal never fails loudly
// Threads    free functions

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "engine/store/open_folder.hpp"

namespace torquescope {

struct ShardChoice {
  std::size_t index = 0, count = 1;
  std::string reason{};  // "--shard", "SLURM_ARRAY_TASK_ID"; "" when the job is not divided

  // its runs of so many, [first, end): neighbours, so that merging reads one segment after the other
  std::size_t first(std::size_t runs) const { return runs * index / count; }
  std::size_t end(std::size_t runs) const { return runs * (index + 1) / count; }
};

// indexes of the shares, of so many, that have a run which is not done
std::vector<std::size_t> unfinished_shares(std::size_t runs, std::size_t shares,
                                           std::function<bool(std::size_t run)> const& is_done);

std::filesystem::path segment_folder_of(std::filesystem::path const& result);

// makes the folder unless it is there; its name is safe against power loss then
void make_segment_folder(std::filesystem::path const& folder);

// throws where the folder is a link, or of another user; one that is not there is fine
void refuse_foreign_folder(std::filesystem::path const& folder);

// what a lock says begins with this
inline constexpr char lock_words[] = "process ";

// of this process, since it began: different on every node and at every start
class SegmentNames {
 public:
  SegmentNames(std::filesystem::path folder, ShardChoice const& shard);
  std::filesystem::path next();
  std::string const& host() const { return host_; }

 private:
  std::filesystem::path folder_;
  std::string host_, begin_;
  std::size_t number_ = 0;
};

// finished segments, sorted by name, to be read while the folder is open; none when there is no folder
std::vector<FilePlace> segments_in(OpenFolder const& folder);

// once the result is whole: the segments of this job, what killed processes left of unfinished ones, and the
// folder unless it holds something else; and what killed processes left of the result itself. A file that a living
// process writes stays. Returns warnings: what was left, and why
std::vector<std::string> remove_segments(std::filesystem::path const& result, std::string const& inputs_sha256);

// only the last of these: what killed processes left of the result itself
void remove_unfinished(std::filesystem::path const& result);

std::string host_name();

}  // namespace torquescope
