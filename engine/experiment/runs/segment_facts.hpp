#pragma once
// What a segment says of itself without its lists: who wrote it, for which job, and which parts of which runs it has.
//
// Why        a process that looks at segments (segment_look.hpp) hands these on, so nobody opens them a second time
// Trust      the numbers of a file lead nowhere outside: facts_of() and unpacked_facts() check them alike
// Errors     65 when they contradict each other, and those of ResultReader
// Threads    values

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "engine/experiment/runs/run_part.hpp"
#include "engine/store/result_reader.hpp"

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

// of one part, without its numbers
struct SegmentEntry {
  std::size_t run, first, count;
  bool ended;
  std::size_t row;                          // where its generations begin in the lists
  std::size_t state_first, state_end;       // entries of its optimiser's state
  std::size_t state_number, state_numbers;  // where their numbers begin, and how many they are
  std::string stop_reason;
};

// of one estimator
struct SegmentIndex {
  std::string search_sha256;  // of all that its numbers follow from, but the program: settings and training data
  HistoryShape shape;
  std::vector<SegmentEntry> entries;
};

struct SegmentFacts {
  std::filesystem::path name;
  std::uint64_t bytes = 0;
  SegmentOrigin origin;
  std::map<std::string, SegmentIndex> estimators;  // by label
};

// where an estimator is in a segment
inline std::string segment_group(std::string const& label) { return "/parts/" + label + "/"; }

Error contradicts_itself(std::filesystem::path const& name, std::string const& what);

SegmentFacts facts_of(ResultReader const& segment);

// as bytes and back, from one process to another; std::out_of_range where the bytes are none of these
std::string packed(SegmentFacts const& facts);
SegmentFacts unpacked_facts(std::filesystem::path const& name, std::string_view bytes);

}  // namespace torquescope
