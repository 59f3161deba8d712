#include "engine/base/toml_nesting.hpp"

#include <algorithm>

namespace torquescope {

namespace {

// offset behind the text that opens at `begin` with ' or " (or three of them); an open end runs to the end of the line
std::size_t skip_quoted(std::string_view text, std::size_t begin) {
  char const quote = text[begin];
  bool const escapes = quote == '"';
  std::string_view const triple = escapes ? R"(""")" : "'''";
  bool const multi_line = text.substr(begin, 3) == triple;
  std::size_t i = begin + (multi_line ? 3 : 1);
  while (i < text.size()) {
    if (escapes && text[i] == '\\') {
      i += 2;
    } else if (multi_line && text.substr(i, 3) == triple) {
      return i + 3;
    } else if (!multi_line && (text[i] == quote || text[i] == '\n')) {
      return i + 1;
    } else {
      ++i;
    }
  }
  return text.size();
}

}  // namespace

std::optional<std::size_t> first_too_deep(std::string_view text, int deepest) {
  int brackets = 0;
  int dots = 0;
  std::size_t i = 0;
  while (i < text.size()) {
    char const letter = text[i];
    if (letter == '"' || letter == '\'') {
      i = skip_quoted(text, i);
      continue;
    }
    if (letter == '#') {
      i = std::min(text.find('\n', i), text.size());
      continue;
    }
    if (letter == '[' || letter == '{') ++brackets;
    if (letter == ']' || letter == '}') brackets = std::max(0, brackets - 1);
    // a key ends where anything but its letters, dots and spaces follows
    if (letter == '.') ++dots;
    if (letter == '\n' || letter == '=' || letter == ',' || letter == '[' || letter == '{') dots = 0;
    if (brackets + dots > deepest) return i;
    ++i;
  }
  return std::nullopt;
}

}  // namespace torquescope
