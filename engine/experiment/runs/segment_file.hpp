#pragma once
// One segment: parts of runs of one job in a small, complete, checksummed file (RESULT_FORMAT.md, "Segments").
//
// Use        write_segment() once; SegmentFile reads it back, its index first, histories when they are asked for: those
//            of several runs at once, for runs are mostly asked for in the order in which they were written
// Trust      the index is believed after its own checksums; histories only after verify(), which reads everything
// Harm       checksums do not keep out who computes them, and HDF5 crashes on some such files: look_at_segment() opens
//            one in a child first, and what did no harm there is read here
// Errors     writing: those of ResultWriter (74); reading: those of ResultReader (65 for whatever is damaged or not
//            ours)
// Threads    as HDF5: one of the process at a time

#include <array>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "engine/experiment/runs/run_part.hpp"
#include "engine/store/file_place.hpp"
#include "engine/store/result_reader.hpp"
#include "engine/store/rows_ahead.hpp"
#include "engine/store/segment_folder.hpp"

namespace torquescope {

// who wrote it, for which job
struct SegmentOrigin {
  std::string job_sha256, inputs_sha256, numerics_sha256;
  std::string job_name;
  std::size_t shard_index = 0, shard_count = 1;
  std::string host;
  std::int64_t pid = 0, threads = 0;
  std::string started, written;  // ISO 8601 UTC
};

struct EstimatorParts {
  std::string label;
  std::string search_sha256;  // of all that its numbers follow from, but the program: settings and training data
  HistoryShape shape;
  std::vector<RunPart> parts;
};

// where an estimator is in a segment
inline std::string segment_group(std::string const& label) { return "/parts/" + label + "/"; }

void write_segment(FilePlace const& place, SegmentOrigin const& origin, std::vector<EstimatorParts> const& estimators);

// Neighbouring runs from their beginning to their end, as a segment has them: their lists one behind the other, as a
// result has them too. Valid until more is read
struct StoredRuns {
  template <class Value>
  struct List {
    std::span<Value const> values{};
    std::shared_ptr<void const> owner{};  // while it lives the values stay
  };
  std::size_t count = 0;
  std::array<List<double>, history_lists.size()> histories{};  // as history_lists; empty: not kept
  List<std::int64_t> evaluations{}, nonfinite{};
  List<double> parameters{};
  std::vector<std::string> stop_reasons{};
  std::vector<OptimiserState> last_states{};
};

class SegmentFile {
 public:
  // of one part, without its numbers
  struct Entry {
    std::size_t run, first, count;
    bool ended;
    std::size_t row;                          // where its generations begin in the lists
    std::size_t state_first, state_end;       // entries of its optimiser's state
    std::size_t state_number, state_numbers;  // where their numbers begin, and how many they are
    std::string stop_reason;
  };
  struct Index {
    std::string search_sha256;
    HistoryShape shape;
    std::vector<Entry> entries;
  };

  // ahead: bytes of it, about, that are read and kept at once
  static constexpr std::size_t most_ahead = std::size_t{2} << 20;
  explicit SegmentFile(FilePlace const& place, std::size_t ahead = most_ahead);

  std::filesystem::path const& name() const { return place_.path; }
  SegmentOrigin const& origin() const { return origin_; }
  std::map<std::string, Index> const& estimators() const { return estimators_; }  // by label
  std::uint64_t bytes() const { return bytes_; }
  void verify() { static_cast<void>(reader().verify()); }
  RunPart read(std::string const& label, std::size_t entry);
  // of entries that are whole runs, each with every generation of the job
  StoredRuns read_runs(std::string const& label, std::size_t first_entry, std::size_t count);
  // the file; what was read stays, and it is opened again when more is asked for
  void close() { reader_.reset(); }

 private:
  // datasets of one estimator
  struct Lists {
    std::string label;
    std::vector<RowsAhead<double>> histories;  // as history_lists
    RowsAhead<std::int64_t> evaluations, nonfinite;
    RowsAhead<double> elapsed_s, parameters;
    RowsAhead<std::string> state_names;
    RowsAhead<std::int64_t> state_sizes;
    RowsAhead<double> state_numbers;
  };

  ResultReader const& reader();
  void read_index(std::string const& label);
  Lists& lists(std::string const& label);
  template <class Value>
  std::span<Value const> rows(RowsAhead<Value>& list, std::size_t first, std::size_t count, std::size_t width);
  OptimiserState read_state(Lists& lists, Entry const& entry);

  FilePlace place_;
  std::optional<ResultReader> reader_;
  std::uint64_t bytes_;
  std::size_t ahead_;
  SegmentOrigin origin_;
  std::map<std::string, Index> estimators_;
  std::optional<Lists> lists_;  // of the estimator that was asked for last
};

// opens a segment in a process of its own, for `look` to read what will be read of it. Errors: those of both; 65 when
// HDF5 crashes, loops or takes too much memory
void look_at_segment(FilePlace const& place, std::function<void(SegmentFile&)> const& look);

// The same for many, in one process: a process costs as much as a small segment. Whether each was read without
// complaint; what was not is to be looked at by itself, which says why
std::vector<bool> harmless_segments(std::vector<FilePlace> const& places,
                                    std::function<void(SegmentFile&)> const& look);

}  // namespace torquescope
