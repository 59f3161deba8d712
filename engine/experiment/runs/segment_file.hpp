#pragma once
// One segment: parts of runs of one job in a small, complete, checksummed file (RESULT_FORMAT.md, "Segments").
//
// Use        write_segment() once; SegmentFile reads it back, its index first, histories when they are asked for: those
//            of several runs at once, for runs are mostly asked for in the order in which they were written
// Trust      the index is believed after its own checksums; histories only after verify(), which reads everything
// Harm       HDF5 crashes on some files of people who mean it: segment_look.hpp reads one in another process first
// Errors     writing: those of ResultWriter (74); reading: those of ResultReader (65 for whatever is damaged or not
//            ours)
// Threads    as HDF5: one of the process at a time

#include <array>
#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "engine/experiment/runs/run_part.hpp"
#include "engine/experiment/runs/segment_facts.hpp"
#include "engine/store/file_place.hpp"
#include "engine/store/result_reader.hpp"
#include "engine/store/rows_ahead.hpp"
#include "engine/store/segment_folder.hpp"

namespace torquescope {

struct EstimatorParts {
  std::string label;
  std::string search_sha256;  // of all that its numbers follow from, but the program: settings and training data
  HistoryShape shape;
  std::vector<RunPart> parts;
};

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
  // ahead: bytes of it, about, that are read and kept at once
  static constexpr std::size_t most_ahead = std::size_t{2} << 20;
  explicit SegmentFile(FilePlace const& place, std::size_t ahead = most_ahead);

  std::filesystem::path const& name() const { return place_.path; }
  SegmentFacts const& facts() const { return facts_; }
  std::map<std::string, SegmentIndex> const& estimators() const { return facts_.estimators; }  // by label
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
  Lists& lists(std::string const& label);
  template <class Value>
  std::span<Value const> rows(RowsAhead<Value>& list, std::size_t first, std::size_t count, std::size_t width);
  OptimiserState read_state(Lists& lists, SegmentEntry const& entry);

  FilePlace place_;
  std::optional<ResultReader> reader_;
  std::size_t ahead_;
  SegmentFacts facts_;
  std::optional<Lists> lists_;  // of the estimator that was asked for last
};

}  // namespace torquescope
