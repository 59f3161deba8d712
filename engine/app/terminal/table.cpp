#include "engine/app/terminal/table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "engine/app/terminal/plain_text.hpp"
#include "engine/base/contract.hpp"

namespace torquescope {

namespace {

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

std::string TextTable::text(int width) const {
  std::vector<int> widths(columns_.size(), 0);
  for (auto const& cells : rows_)
    for (std::size_t c = 0; c < cells.size(); ++c) widths[c] = std::max(widths[c], columns_of(cells[c]));

  int before_last = columns_of(indent_);
  for (std::size_t c = 0; c + 1 < widths.size(); ++c) before_last += widths[c] + 2;
  int const last_room = std::max(20, width - before_last);

  std::string text;
  for (auto const& cells : rows_) {
    std::string line = indent_;
    for (std::size_t c = 0; c + 1 < cells.size(); ++c)
      line += (columns_[c] == Align::left ? pad_right(cells[c], widths[c]) : pad_left(cells[c], widths[c])) + "  ";
    if (columns_.back() == Align::right) {
      text += without_trailing_spaces(line + pad_left(cells.back(), widths.back())) + "\n";
      continue;
    }
    for (auto const& piece : wrap(cells.back(), last_room, last_room)) {
      text += without_trailing_spaces(line + piece) + "\n";
      line = std::string(static_cast<std::size_t>(before_last), ' ');
    }
  }
  return text;
}

std::string short_number(double value) { return std::isnan(value) ? "" : fmt::format("{:.4g}", value); }

std::string rough_number(double value) { return std::isnan(value) ? "" : fmt::format("{:.1g}", value); }

}  // namespace torquescope
