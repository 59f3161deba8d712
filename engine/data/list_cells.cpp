#include "engine/data/list_cells.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "engine/data/delimited_text.hpp"

namespace torquescope {

std::vector<std::string_view> list_elements(std::string_view cell) {
  if (cell.size() >= 2 && cell.front() == '"' && cell.back() == '"') cell = cell.substr(1, cell.size() - 2);
  if (cell.size() < 3 || cell.front() != '[' || cell.back() != ']') return {};
  std::string_view const inside = cell.substr(1, cell.size() - 2);
  std::vector<std::string_view> elements;
  for (std::size_t from = inside.find_first_not_of(" \t"); from < inside.size();) {
    std::size_t const until = std::min(inside.find_first_of(",; \t", from), inside.size());
    elements.push_back(inside.substr(from, until - from));
    double ignored = 0.0;
    if (elements.back().empty() || read_cell(elements.back(), ignored) == CellKind::text) return {};
    std::size_t next = std::min(inside.find_first_not_of(" \t", until), inside.size());
    bool const has_mark = next < inside.size() && (inside[next] == ',' || inside[next] == ';');
    if (has_mark) next = std::min(inside.find_first_not_of(" \t", next + 1), inside.size());
    from = next;
  }
  return elements;
}

ListColumns::ListColumns(std::vector<std::string_view> const& first_row) {
  for (auto cell : first_row) elements_.push_back(list_elements(cell).size());
  any_ = std::any_of(elements_.begin(), elements_.end(), [](std::size_t n) { return n > 0; });
}

std::vector<std::string> ListColumns::spread_names(std::vector<std::string> const& names) const {
  std::vector<std::string> spread;
  for (std::size_t c = 0; c < names.size(); ++c) {
    std::size_t const n = c < elements_.size() ? elements_[c] : 0;
    if (n == 0) spread.push_back(names[c]);
    for (std::size_t k = 0; k < n; ++k) spread.push_back(fmt::format("{}[{}]", names[c], k));
  }
  return spread;
}

std::vector<std::string> ListColumns::spread_units(std::vector<std::string> const& units) const {
  std::vector<std::string> spread;
  for (std::size_t c = 0; c < units.size(); ++c)
    spread.insert(spread.end(), c < elements_.size() ? std::max<std::size_t>(1, elements_[c]) : 1, units[c]);
  return spread;
}

void ListColumns::spread_cells(std::vector<std::string_view>& cells) const {
  std::vector<std::string_view> spread;
  for (std::size_t c = 0; c < cells.size(); ++c) {
    std::size_t const n = c < elements_.size() ? elements_[c] : 0;
    auto const found = n > 0 ? list_elements(cells[c]) : std::vector<std::string_view>{};
    bool const fits = n > 0 && found.size() == n;
    if (fits)
      spread.insert(spread.end(), found.begin(), found.end());
    else
      spread.insert(spread.end(), std::max<std::size_t>(1, n), cells[c]);
  }
  cells = std::move(spread);
}

}  // namespace torquescope
