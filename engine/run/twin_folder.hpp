#pragma once
// The twins of one diagnosis, shared by several processes through files in RESULT.parts.
//
// Parts      a batch that is worth it is cut into parts, the same in every process. Each begins with those of its own
//            share and goes on with whatever nobody has done or is doing: a part is claimed (flock) while it is
//            computed, then published, and taken by the others. So one process alone makes all of them, one that comes
//            late catches up, one that was killed holds nothing, and the same command takes up what was published
// Waiting    for parts that a living process is computing, no longer than it could take; then they are computed here
// Trust      a part counts when every byte fits its SHA-256 and its key: the job, the recordings, the program, the
//            place among the batches, what the twins follow from. Any other one is computed again and replaced
// No disk    nothing is published where it would take the room of the result, or cannot be written; the diagnosis goes
//            on
// No locks   (some network file systems) every process computes whatever is not there yet
// Files      batch-<number>.part-<i>-of-<n>.<8 letters of the job>.twins, and .lock beside it while it is computed;
//            removed with the folder when the result stands (remove_segments). A file of such a name that is not of
//            this job is neither read nor replaced
// Errors     TwinsAbandoned when a stop is asked for, or another process has published the result
// Threads    as TwinExchange

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "engine/store/number_file.hpp"
#include "engine/store/own_folder.hpp"
#include "engine/store/segment_folder.hpp"
#include "engine/twin/twin_exchange.hpp"

namespace torquescope {

class TwinFolder final : public TwinExchange {
 public:
  struct Setting {
    std::filesystem::path result;
    ShardChoice shard{};
    std::string inputs_sha256{};         // of job and recordings
    std::uintmax_t bytes_kept_free = 0;  // for the result
    std::function<bool()> must_end{};    // asked before every part, and while waiting
    std::function<void(std::string const& topic, std::string const& text)> tell{};  // "warning"
    // samples of all twins that two processes gain by sharing, below which a file costs more
    double least_gain = 2.5e5;
  };
  explicit TwinFolder(Setting setting);

  void fill(TwinBatch const& batch) override;

  std::size_t parts_taken() const { return taken_; }  // from files
  std::size_t parts_made() const { return made_; }    // here
  std::string account() const;                        // "12 of 25 parts of the twins were simulated here"

 private:
  struct Part {
    TwinRange range;
    std::filesystem::path file;
    NumberFileKey key;
    bool is_foreign = false;  // somebody else's file stands there
  };

  bool is_worth_it(TwinBatch const& batch) const;
  std::vector<Part> parts_of(TwinBatch const& batch) const;
  void fill_parts(TwinBatch const& batch, std::vector<Part> parts);
  bool take(TwinBatch const& batch, Part& part);
  bool claim_and_make(TwinBatch const& batch, Part& part);
  void make(TwinBatch const& batch, Part const& part);
  void publish(TwinBatch const& batch, Part const& part);
  void warn(std::string const& text) const;

  Setting setting_;
  OwnFolder folder_;
  Sha256 job_;
  std::string program_;
  bool publishes_ = true;
  std::size_t batches_ = 0, taken_ = 0, made_ = 0;
  double longest_part_s_ = 0.0;
  std::vector<double> numbers_;  // of one part
};

}  // namespace torquescope
