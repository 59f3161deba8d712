#include "engine/app/terminal/plain_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace torquescope {

namespace {

bool is_continuation(char byte) { return (static_cast<unsigned char>(byte) & 0xC0) == 0x80; }

// bytes of the well-formed, visible character at the front of `text`; 0 when it is broken or a control character
std::size_t visible_bytes(std::string_view text) {
  auto const first = static_cast<unsigned char>(text[0]);
  if (first < 0x80) return first >= 0x20 && first != 0x7F ? 1 : 0;
  std::size_t const length = first >= 0xF0 ? 4 : first >= 0xE0 ? 3 : 2;
  if (first < 0xC2 || first > 0xF4 || text.size() < length) return 0;
  for (std::size_t i = 1; i < length; ++i)
    if (!is_continuation(text[i])) return 0;
  // U+0080 to U+009F are control characters too
  if (first == 0xC2 && static_cast<unsigned char>(text[1]) < 0xA0) return 0;
  return length;
}

}  // namespace

std::string printable(std::string_view text) {
  std::string shown;
  while (!text.empty()) {
    std::size_t const length = visible_bytes(text);
    if (length == 0) {
      shown += text[0] == '\t' ? ' ' : '?';
      text.remove_prefix(1);
      while (!text.empty() && is_continuation(text[0])) text.remove_prefix(1);
    } else {
      shown += text.substr(0, length);
      text.remove_prefix(length);
    }
  }
  return shown;
}

int columns_of(std::string_view utf8) {
  int columns = 0;
  bool in_escape = false;
  for (char const byte : utf8) {
    if (byte == '\x1b') in_escape = true;
    if (!in_escape && !is_continuation(byte)) ++columns;
    if (byte == 'm') in_escape = false;
  }
  return columns;
}

std::vector<std::string> wrap(std::string const& text, int first_width, int width) {
  std::vector<std::string> lines{""};
  std::size_t begin = 0;
  while (begin < text.size()) {
    // a word with the spaces before it: wide gaps inside a line are meant
    std::size_t const word = std::min(text.find_first_not_of(' ', begin), text.size());
    std::size_t const end = std::min(text.find(' ', word), text.size());
    std::string const piece = text.substr(begin, end - begin);
    int const limit = lines.size() == 1 ? first_width : width;
    if (!lines.back().empty() && columns_of(lines.back()) + columns_of(piece) > limit) {
      lines.push_back(text.substr(word, end - word));
    } else {
      lines.back() += piece;
    }
    begin = end;
  }
  if (lines.size() > 1 && lines.back().empty()) lines.pop_back();
  return lines;
}

std::string lead(std::string const& topic) { return pad_right(topic, lead_columns); }

std::string hanging(std::string const& lead, std::string const& text, int width) {
  int const indent = columns_of(lead);
  std::string result;
  for (auto const& line : wrap(text, width - indent, width - indent))
    result += (result.empty() ? lead : std::string(static_cast<std::size_t>(indent), ' ')) + line + "\n";
  return result;
}

std::string pad_right(std::string text, int columns) {
  int const missing = columns - columns_of(text);
  if (missing > 0) text.append(static_cast<std::size_t>(missing), ' ');
  return text;
}

std::string pad_left(std::string text, int columns) {
  int const missing = columns - columns_of(text);
  if (missing > 0) text.insert(0, static_cast<std::size_t>(missing), ' ');
  return text;
}

std::string count_text(std::int64_t count) {
  std::string digits = fmt::format("{}", count);
  for (auto i = static_cast<std::ptrdiff_t>(digits.size()) - 3; i > (count < 0 ? 1 : 0); i -= 3)
    digits.insert(static_cast<std::size_t>(i), " ");
  return digits;
}

std::string bytes_text(std::uintmax_t bytes) {
  double size = static_cast<double>(bytes);
  if (size < 1000.0) return fmt::format("{} B", bytes);
  char const* unit = "kB";
  size /= 1000.0;
  for (char const* next : {"MB", "GB", "TB"}) {
    if (size < 999.95) break;
    size /= 1000.0;
    unit = next;
  }
  return size < 99.95 ? fmt::format("{:.1f} {}", size, unit) : fmt::format("{:.0f} {}", size, unit);
}

std::string seconds_text(double seconds) {
  if (!std::isfinite(seconds) || seconds < 0.0) return "? s";
  if (seconds < 0.9995) return fmt::format("{:.3f} s", seconds);
  if (seconds < 59.95) return fmt::format("{:.1f} s", seconds);
  auto const whole = static_cast<std::int64_t>(std::llround(seconds));
  if (whole < 3600) return fmt::format("{} min {} s", whole / 60, whole % 60);
  return fmt::format("{} h {} min", whole / 3600, whole / 60 % 60);
}

}  // namespace torquescope
