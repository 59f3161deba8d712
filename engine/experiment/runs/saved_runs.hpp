#pragma once
// What segments know of the runs of a job: what is done, and what each run goes on from.
//
// Trust      only segments that verify() whole: one that is damaged counts as absent, its generations run again
// Twice      generations that two segments have must be equal, bit by bit: two attempts of one run disagree only when
//            something is broken, a machine or this program
// Meanwhile  living processes gather their segments (segment_pile.hpp): when one is gone, the folder is listed again
// Errors     65 when two segments disagree (both are named); 78 when a segment belongs to another job, or to another
//            program unless that is allowed
// Memory     an index of all runs (32 bytes each), and up to 256 MiB of what segments have next, however many they are;
//            of one segment 2 MiB where each has neighbouring runs
// Threads    as HDF5: one of the process at a time

#include <cstddef>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "engine/experiment/runs/segment_file.hpp"

namespace torquescope {

struct SavedRunsRequest {
  std::filesystem::path own_folder;                   // of this job: refused where it is not this user's
  std::vector<std::filesystem::path> more_folders{};  // that somebody has named
  SegmentOrigin expected;                             // the job and the program that would go on
  std::map<std::string, std::string> searches;        // search_sha256 of every population method, by label
  bool allow_mixed =
      false;  // take segments of another program, or of a job whose other text changes no number of these
  std::function<bool(std::size_t run)> wanted{};  // segments without such runs are not read further; empty: all
};

class SavedRuns {
 public:
  SavedRuns() = default;
  explicit SavedRuns(SavedRunsRequest const& request);

  // run by run, by what the indexes say
  bool has_ended(std::string const& label, std::size_t run) const;
  std::size_t generations(std::string const& label, std::size_t run) const;  // without a gap, from 0 on

  // its history so far, and the optimiser's state when it has not ended; nothing when no segment has its beginning
  std::optional<RunPart> load(std::string const& label, HistoryShape const& shape, std::size_t run);

  // `run` and up to `most` - 1 that follow it, where one segment has them side by side from their beginning to the
  // job's last generation, and no other has any of them; nothing where `run` is not such a one
  std::optional<StoredRuns> load_stored(std::string const& label, HistoryShape const& shape, std::size_t run,
                                        std::size_t most);

  std::vector<FilePlace> const& files() const { return files_; }          // every segment taken
  std::vector<SegmentOrigin> const& origins() const { return origins_; }  // of each of them
  std::vector<std::string> const& warnings() const { return warnings_; }  // what was left aside, and why
  bool empty() const { return files_.empty(); }
  bool mixed() const { return mixed_; }

 private:
  // there may be millions
  struct Piece {
    std::size_t run;
    std::uint32_t file, entry, first, end;
    bool ended;
  };
  using Pieces = std::vector<Piece>;
  using PiecesOfRun = std::span<Piece const>;

  void read_all();
  bool read_folder(OpenFolder const& folder);
  std::optional<RunPart> load_now(std::string const& label, HistoryShape const& shape, std::size_t run);

  std::optional<StoredRuns> load_stored_now(std::string const& label, HistoryShape const& shape, std::size_t run,
                                            std::size_t most);
  template <class Load>
  auto listing_again(Load&& load) -> decltype(load());

  PiecesOfRun find(std::string const& label, std::size_t run) const;
  bool accept(SegmentFacts const& file, SavedRunsRequest const& request);
  void take(SegmentFacts const& file, std::size_t index);
  std::size_t shards() const;  // that wrote the segments
  SegmentFile& opened(Piece const& piece);

  SavedRunsRequest request_;
  std::vector<std::shared_ptr<OpenFolder const>> folders_;  // of the files
  std::vector<FilePlace> files_;
  struct Opened {
    std::unique_ptr<SegmentFile> file;
    std::uint64_t asked;   // when it was asked for last
    std::size_t last_run;  // that it has anything of
  };
  std::map<std::size_t, Opened> open_;  // of every shard about one, where runs come from all of them in turns
  std::uint64_t n_asked_ = 0;
  std::size_t n_shards_ = 1;
  std::map<std::string, Pieces> pieces_;  // by label, sorted by run and first generation
  std::vector<SegmentOrigin> origins_;
  std::vector<std::string> warnings_;
  bool mixed_ = false;
};

}  // namespace torquescope
