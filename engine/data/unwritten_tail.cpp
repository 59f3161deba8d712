#include "engine/data/unwritten_tail.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string_view>

namespace torquescope {
namespace {

using Column = std::vector<double>;

// rows before the last run of values for which `blank` holds
template <class Blank>
std::size_t written_rows(Column const& column, Blank const& blank) {
  std::size_t n = column.size();
  while (n > 0 && blank(column[n - 1])) --n;
  return n;
}

bool counts_rows(Column const& column) {
  for (std::size_t i = 1; i < column.size(); ++i)
    if (column[i] != column[i - 1] + 1.0) return false;
  return true;
}

bool rises(Column const& column, std::size_t n) {
  for (std::size_t i = 1; i < n; ++i)
    if (!(column[i] >= column[i - 1])) return false;
  return n > 1 && column[n - 1] > column[0];
}

// the most rows that any column was written in; all of them when the rest is not blank in every column
template <class Blank>
std::size_t common_written_rows(std::vector<Column> const& columns, Blank const& blank) {
  std::size_t most = 0;
  for (auto const& column : columns)
    if (!counts_rows(column)) most = std::max(most, written_rows(column, blank));
  return most;
}

void cut(RawTable& table, std::size_t n, std::string_view what) {
  std::size_t const n_rows = table.columns.front().size();
  table.remarks.push_back(fmt::format(
      "The last {} of {} rows hold {}, as space that was never written: they are left out.", n_rows - n, n_rows, what));
  for (auto& column : table.columns) column.resize(n);
  if (!table.line_of_row.empty()) table.line_of_row.resize(n);
}

}  // namespace

void drop_unwritten_tail(RawTable& table) {
  constexpr std::size_t fewest = 2;
  if (table.columns.empty()) return;
  std::size_t const n_rows = table.columns.front().size();
  auto const is_cut = [&](std::size_t n) { return n > 1 && n + fewest <= n_rows; };

  std::size_t const with_numbers = common_written_rows(table.columns, [](double value) { return std::isnan(value); });
  if (is_cut(with_numbers)) return cut(table, with_numbers, "no number in any column");

  std::size_t const not_zero = common_written_rows(table.columns, [](double value) { return value == 0.0; });
  bool const has_clock =
      is_cut(not_zero) && std::any_of(table.columns.begin(), table.columns.end(), [&](auto const& column) {
        return written_rows(column, [](double value) { return value == 0.0; }) == not_zero && rises(column, not_zero);
      });
  if (has_clock) cut(table, not_zero, "nothing but zeros");
}

}  // namespace torquescope
