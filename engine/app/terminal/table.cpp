#include "engine/app/terminal/table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "engine/app/terminal/plain_text.hpp"
#include "engine/base/contract.hpp"

namespace torquescope {

namespace {

constexpr int least_last = 20;  // columns that wrapped text needs to be read
constexpr int further_in = 4;   // of what has no room beside the others

std::string without_trailing_spaces(std::string text) {
  text.erase(text.find_last_not_of(' ') + 1);
  return text;
}

}  // namespace

void TextTable::row(std::vector<std::string> cells) {
  TORQUESCOPE_EXPECT(cells.size() <= columns_.size());
  cells.resize(columns_.size());
  rows_.push_back(std::move(cells));
}

std::vector<TextTable::Band> TextTable::bands(std::vector<int> const& widths, int width) const {
  std::vector<Band> found;
  std::size_t begin = 0;
  int used = columns_of(indent_);
  for (std::size_t c = 0; c < widths.size(); ++c) {
    bool const wraps = c + 1 == widths.size() && columns_.back() == Align::left;
    int const needs = wraps ? std::min(least_last, widths[c]) : widths[c];
    if (c > begin && used + needs > width) {
      found.push_back({begin, c});
      begin = c;
      used = columns_of(indent_) + further_in;
    }
    used += widths[c] + 2;
  }
  found.push_back({begin, widths.size()});
  return found;
}

std::string TextTable::line_of(std::vector<std::string> const& cells, Band band, std::vector<int> const& widths,
                               int width) const {
  std::string line = indent_ + std::string(band.begin > 0 ? further_in : 0, ' ');
  bool const wraps = band.end == cells.size() && columns_.back() == Align::left;
  for (std::size_t c = band.begin; c < band.end - (wraps ? 1 : 0); ++c)
    line += (columns_[c] == Align::left ? pad_right(cells[c], widths[c]) : pad_left(cells[c], widths[c])) + "  ";
  if (!wraps) return without_trailing_spaces(std::move(line)) + "\n";
  int const before = columns_of(line), room = std::max(least_last, width - before);
  std::string text;
  for (auto const& piece : wrap(cells.back(), room, room)) {
    text += without_trailing_spaces(line + piece) + "\n";
    line = std::string(static_cast<std::size_t>(before), ' ');
  }
  return text;
}

std::string TextTable::text(int width) const {
  std::vector<int> widths(columns_.size(), 0);
  for (auto const& cells : rows_)
    for (std::size_t c = 0; c < cells.size(); ++c) widths[c] = std::max(widths[c], columns_of(cells[c]));
  std::string text;
  for (auto const& cells : rows_)
    for (Band const band : bands(widths, width)) {
      std::string const line = line_of(cells, band, widths, width);
      if (band.begin == 0 || line != "\n") text += line;  // nothing of this row stands below
    }
  return text;
}

std::string short_number(double value) { return std::isnan(value) ? "" : fmt::format("{:.4g}", value); }

std::string rough_number(double value) { return std::isnan(value) ? "" : fmt::format("{:.1g}", value); }

}  // namespace torquescope
