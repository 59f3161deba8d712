#pragma once
// The replicates of one diagnosis, shared by several processes through files in RESULT.parts.
//
// Parts      a large batch is cut into parts, the same in every process. A process begins with its own share and goes
//            on with what nobody has done: it claims a part (flock), computes and publishes it. One process alone makes
//            all of them; a killed one holds nothing; the same command takes up what was published
// Waiting    for parts of a living process, no longer than they could take; then they are computed here
// Trust      a part counts when its bytes fit their SHA-256 and its key: job, recordings, program, batch, inputs
// No disk    nothing is published where it would take the room of the result; without locks everybody computes
// Files      batch-<number>.part-<i>-of-<n>.<8 letters of the job>.twins and .lock beside it; removed with the folder
//            when the result stands. A file of such a name that is not of this job is neither read nor replaced
// Errors     TwinsAbandoned when a stop is asked for, or another process has published the result
// Threads    as TwinExchange

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "engine/infer/replicates/twin_exchange.hpp"
#include "engine/store/number_file.hpp"
#include "engine/store/own_folder.hpp"
#include "engine/store/segment_folder.hpp"

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
    // samples of all replicates that two processes gain by sharing, below which a file costs more
    double least_gain = 2.5e5;
  };
  explicit TwinFolder(Setting setting);

  void fill(TwinBatch const& batch) override;

  std::string account() const;  // "12 of 25 parts of the replicates were simulated here"

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
  std::size_t batches_ = 0, taken_ = 0, made_ = 0;  // parts from files, parts made here
  double longest_part_s_ = 0.0;
  std::vector<double> numbers_;  // of one part
};

}  // namespace torquescope
