#pragma once
// Collects named columns of a binary file, whose variables need not have one length, into a RawTable of equal lengths.
//
// The samples are the longest length that two columns share (a file has signals and, beside them, parameters), and
// every other length that has a clock of its own (block_lengths.hpp); the rest becomes unusable with a reason.
//
// Errors     Error 65 when nothing is left, or when all columns together exceed most_values

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "engine/data/file_bytes.hpp"
#include "engine/data/recording_reader.hpp"

namespace torquescope {

class TableBuilder {
 public:
  // most_values: what so large a file can hold at most
  TableBuilder(std::string path, std::string sha256, std::uint64_t most_values = most_table_values);

  // call before allocating n_values more: the limit of the whole table
  void reserve(std::uint64_t n_rows, std::uint64_t n_columns, std::string const& name);
  void add(std::string name, std::vector<double> values);
  // "name", or "name[0]", "name[1]", ... of a matrix; names: one per column, or empty
  void add_matrix(std::string const& name, std::span<double const> values, std::size_t n_rows, std::size_t n_columns,
                  bool column_major, std::vector<std::string> const& names = {});
  void cannot_use(std::string name, std::string reason);
  void remark(std::string sentence);
  RawTable finish() &&;

 private:
  std::size_t common_length() const;
  std::vector<std::vector<std::size_t>> blocks() const;

  RawTable table_;
  std::uint64_t most_values_;
  std::uint64_t n_values_ = 0;
};

}  // namespace torquescope
