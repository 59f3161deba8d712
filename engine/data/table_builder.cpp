#include "engine/data/table_builder.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <map>
#include <utility>

#include "engine/base/contract.hpp"
#include "engine/base/error.hpp"
#include "engine/data/block_lengths.hpp"
#include "engine/data/data_problem.hpp"
#include "engine/data/file_bytes.hpp"

namespace torquescope {

TableBuilder::TableBuilder(std::string path, std::string sha256, std::uint64_t most_values)
    : most_values_(std::min(most_values, most_table_values)) {
  table_.path = std::move(path);
  table_.sha256 = std::move(sha256);
}

void TableBuilder::reserve(std::uint64_t n_rows, std::uint64_t n_columns, std::string const& name) {
  // divided, because a hostile size would overflow the product
  bool const fits = n_columns == 0 || n_rows <= (most_values_ - n_values_) / n_columns;
  validate(fits, [&] {
    return bad_data(
        fmt::format("\"{}\" claims {} x {} numbers; {}", name, n_rows, n_columns,
                    most_values_ < most_table_values ? fmt::format("a file of this size holds at most {}", most_values_)
                                                     : fmt::format("one recording may hold {}", most_values_)),
        table_.path, 0, "the file is damaged, or has to be cut into several recordings");
  });
  n_values_ += n_rows * n_columns;
}

void TableBuilder::add(std::string name, std::vector<double> values) {
  table_.names.push_back(std::move(name));
  table_.columns.push_back(std::move(values));
}

void TableBuilder::add_matrix(std::string const& name, std::span<double const> values, std::size_t n_rows,
                              std::size_t n_columns, bool column_major, std::vector<std::string> const& names) {
  TORQUESCOPE_EXPECT(values.size() == n_rows * n_columns);
  bool const is_vector = n_rows == 1 || n_columns == 1;
  if (is_vector && names.size() != n_columns) {
    add(name, {values.begin(), values.end()});
    return;
  }
  for (std::size_t c = 0; c < n_columns; ++c) {
    std::vector<double> column(n_rows);
    for (std::size_t r = 0; r < n_rows; ++r) column[r] = values[column_major ? c * n_rows + r : r * n_columns + c];
    add(names.size() == n_columns ? names[c] : fmt::format("{}[{}]", name, c), std::move(column));
  }
}

void TableBuilder::cannot_use(std::string name, std::string reason) {
  table_.unusable.push_back({std::move(name), std::move(reason)});
}

void TableBuilder::remark(std::string sentence) { table_.remarks.push_back(std::move(sentence)); }

std::size_t TableBuilder::common_length() const {
  std::map<std::size_t, int> count_of_length;
  for (auto const& column : table_.columns) ++count_of_length[column.size()];
  std::size_t longest_shared = 0;
  for (auto const& [length, count] : count_of_length)
    if (count > 1) longest_shared = length;
  return longest_shared > 0 ? longest_shared : count_of_length.rbegin()->first;
}

namespace {

std::string other_length(std::size_t values, std::size_t samples) {
  constexpr std::size_t a_signal = 16;  // less is a parameter
  auto const text = fmt::format("has {} values where the signals have {}", values, samples);
  return values < a_signal ? text : fmt::format("{}, and no time stamps of its own: a vector of {}", text, values);
}

}  // namespace

// Columns that serve, by their length: of the samples first, then of other lengths with a clock. With several the clock
// of each stands first
std::vector<std::vector<std::size_t>> TableBuilder::blocks() const {
  std::map<std::size_t, std::vector<std::size_t>> of_length;
  for (std::size_t c = 0; c < table_.columns.size(); ++c) of_length[table_.columns[c].size()].push_back(c);
  std::vector<std::vector<std::size_t>> kept{of_length.at(common_length())};
  auto const clock = clock_among(table_.names, table_.columns, kept.front());
  if (!clock) return kept;
  std::size_t const longest = of_length.rbegin()->first;
  if (longest * table_.columns.size() > most_table_values) return kept;  // all are filled up to one length
  for (auto const& [length, block] : of_length) {
    auto const own = length == common_length() ? std::nullopt : clock_among(table_.names, table_.columns, block);
    bool const serves = own && block.size() > 1 && run_together(table_.columns[*clock], table_.columns[*own]);
    if (!serves) continue;
    kept.push_back(block);
    std::stable_partition(kept.back().begin(), kept.back().end(), [&](std::size_t c) { return c == *own; });
  }
  if (kept.size() > 1)
    std::stable_partition(kept.front().begin(), kept.front().end(), [&](std::size_t c) { return c == *clock; });
  return kept;
}

RawTable TableBuilder::finish() && {
  validate(!table_.columns.empty(), [&] {
    auto problem = bad_data(fmt::format("{} holds no columns of numbers", table_.path), table_.path, 0,
                            "store every signal as a vector of numbers, all of one length");
    problem.notes = table_.remarks;
    for (auto const& column : table_.unusable) problem.notes.push_back("\"" + column.name + "\" " + column.reason);
    if (problem.notes.size() > 8) problem.notes.resize(8);
    return problem;
  });
  auto const kept = blocks();
  std::size_t const length = table_.columns[kept.front().front()].size();
  RawTable result{table_.path, table_.sha256, {}, {}, {}, std::move(table_.unusable)};
  result.remarks = std::move(table_.remarks);
  std::size_t longest = length;
  for (auto const& block : kept) longest = std::max(longest, table_.columns[block.front()].size());
  std::vector<bool> is_kept(table_.columns.size(), false);
  for (auto const& block : kept) {
    std::string const clock = table_.names[block.front()];
    for (std::size_t c : block) {
      is_kept[c] = true;
      if (kept.size() > 1) {
        result.lengths.push_back(table_.columns[c].size());
        result.clocks.push_back(clock);
        table_.columns[c].resize(longest, std::numeric_limits<double>::quiet_NaN());
      }
      result.names.push_back(table_.names[c]);
      result.columns.push_back(std::move(table_.columns[c]));
    }
  }
  for (std::size_t c = 0; c < table_.columns.size(); ++c)
    if (!is_kept[c]) result.unusable.push_back({table_.names[c], other_length(table_.columns[c].size(), length)});
  return result;
}

}  // namespace torquescope
