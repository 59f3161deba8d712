#include "engine/data/clock_blocks.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "engine/data/column_name.hpp"
#include "engine/data/columns.hpp"
#include "engine/data/repeated_names.hpp"

namespace torquescope {
namespace {

struct Span {
  double from = 0.0, until = 0.0;
};

// of stamps that run forwards from the first row to their last
bool runs_as_clock(std::vector<double> const& values, Span& span) {
  std::size_t n = 0;
  while (n < values.size() && std::isfinite(values[n]) && (n == 0 || values[n] >= values[n - 1])) ++n;
  constexpr std::size_t fewest = 16;
  bool const ends = std::all_of(values.begin() + static_cast<std::ptrdiff_t>(n), values.end(),
                                [](double value) { return std::isnan(value); });
  if (n < fewest || !ends || !(values[n - 1] > values[0])) return false;
  span = {values[0], values[n - 1]};
  return true;
}

// "X", "Position.X", "Time 2", "t [ms]"
bool is_called_clock(std::string const& name, std::string const& unit) {
  auto const parsed = parse_column_name(name, unit);
  if (column_role(parsed).quantity == WordKind::time) return true;
  std::string const plain = without_repeat(name);
  return plain == "X" || plain == "x" || plain.ends_with(".X") || plain.ends_with(".x");
}

bool overlap(Span const& a, Span const& b) {
  double const shared = std::min(a.until, b.until) - std::max(a.from, b.from);
  return shared > std::min(a.until - a.from, b.until - b.from) / 2;
}

}  // namespace

std::map<std::string, std::string> clocks_of_columns(RawTable const& table) {
  if (!table.clocks.empty()) {
    std::map<std::string, std::string> by_length;
    for (std::size_t c = 0; c < table.names.size(); ++c)
      if (table.names[c] != table.clocks[c]) by_length[table.names[c]] = table.clocks[c];
    return by_length;
  }
  std::map<std::string, std::string> clocks;
  std::vector<Span> spans;
  std::string clock;
  bool has_values = true;  // the clock at hand has a column behind it
  for (std::size_t c = 0; c < table.names.size(); ++c) {
    Span span;
    bool const is_clock = is_called_clock(table.names[c], c < table.units.size() ? table.units[c] : "") &&
                          runs_as_clock(table.columns[c], span);
    if (!is_clock) {
      if (clock.empty()) return {};
      clocks[table.names[c]] = clock;
      has_values = true;
      continue;
    }
    bool const fits = has_values && std::all_of(spans.begin(), spans.end(), [&](auto& s) { return overlap(s, span); });
    if (!fits) return {};  // two clocks side by side are one clock in two units
    clock = table.names[c];
    spans.push_back(span);
    has_values = false;
  }
  return spans.size() > 1 && has_values ? clocks : std::map<std::string, std::string>{};
}

bool is_same_clock(RawTable const& table, std::string const& one, std::string const& other) {
  auto const &a = values_of(table, one), &b = values_of(table, other);
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](double x, double y) { return x == y || (std::isnan(x) && std::isnan(y)); });
}

}  // namespace torquescope
