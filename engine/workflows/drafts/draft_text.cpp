#include "engine/workflows/drafts/draft_text.hpp"

#include <fmt/format.h>

#include <cmath>
#include <string_view>

namespace torquescope {

namespace {

constexpr std::size_t widest = 100, column_of_comments = 30;

}  // namespace

std::string toml_text(std::string const& value) {
  std::string text = "\"";
  for (char letter : value) {
    auto const code = static_cast<unsigned char>(letter);
    if (letter == '"' || letter == '\\')
      text += fmt::format("\\{}", letter);
    else if (code < 0x20 || code == 0x7f)
      text += fmt::format("\\u{:04x}", code);
    else
      text.push_back(letter);
  }
  return text + "\"";
}

std::string toml_number(double value) {
  constexpr double exact_whole = 1e15;
  if (value == std::round(value) && std::fabs(value) < exact_whole) return fmt::format("{:.0f}", value);
  return fmt::format("{:.9g}", value);
}

std::string toml_list(std::vector<std::string> const& texts) {
  if (texts.size() == 1) return toml_text(texts.front());
  std::string list = "[";
  for (auto const& text : texts) list += (list.size() > 1 ? ", " : "") + toml_text(text);
  return list + "]";
}

void DraftText::section(std::string const& header) { text_ += "\n" + header + "\n"; }

void DraftText::setting(std::string const& key, std::string const& value, std::string const& comment) {
  line(fmt::format("{} = {}", key, value), comment);
}

void DraftText::to_edit(std::string const& key, std::string const& value, std::string const& comment) {
  line(fmt::format("# {} = {}", key, value), comment);
}

void DraftText::comment(std::string const& text) {
  std::string current = "#";
  for (std::size_t from = 0; from < text.size();) {
    std::size_t const to = std::min(text.find(' ', from), text.size());
    std::string const word = text.substr(from, to - from);
    if (current.size() + 1 + word.size() > widest && current != "#") {
      text_ += current + "\n";
      current = "#";
    }
    current += " " + word;
    from = to + 1;
  }
  text_ += current + "\n";
}

void DraftText::line(std::string const& begin, std::string const& said) {
  if (said.empty()) {
    text_ += begin + "\n";
    return;
  }
  std::string const padded = fmt::format("{:<{}}  # {}", begin, column_of_comments, said);
  if (padded.size() <= widest) {
    text_ += padded + "\n";
    return;
  }
  comment(said + ":");
  text_ += begin + "\n";
}

}  // namespace torquescope
