#include "engine/data/compound_word.hpp"

#include <algorithm>
#include <optional>

namespace torquescope {
namespace {

bool tells_who(WordKind kind) { return kind == WordKind::commanded || kind == WordKind::measured; }

// "ides" -> i and des; "actpos" -> act and pos; nothing when it is no quantity beside a modifier
std::vector<ColumnWord> quantity_and_modifier(std::string const& word) {
  for (std::size_t at = 1; at < word.size(); ++at) {
    auto const first = column_word(word.substr(0, at)), second = column_word(word.substr(at));
    if (!first || !second || is_quantity(first->kind) == is_quantity(second->kind)) continue;
    auto const& modifier = is_quantity(first->kind) ? *second : *first;
    bool const one_letter = at + 1 == word.size() && !is_quantity(second->kind);  // "posr" is no word
    if (!one_letter && tells_who(modifier.kind)) return {*first, *second};
  }
  return {};
}

// the parts from `at` to the end, the longest first; a linking "s" or "en" may stand between two
std::optional<std::vector<ColumnWord>> parts_from(std::string const& word, std::size_t at) {
  constexpr std::size_t shortest = 3;
  if (at == word.size()) return std::vector<ColumnWord>{};
  for (std::size_t length = word.size() - at; length > 0; --length) {
    auto const part = column_word(word.substr(at, length));
    if (!part || (length < shortest && part->kind != WordKind::filler)) continue;
    if (auto rest = parts_from(word, at + length)) {
      rest->insert(rest->begin(), *part);
      return rest;
    }
  }
  return {};
}

bool is_ascii(std::string const& word) {
  return std::all_of(word.begin(), word.end(), [](char letter) { return (letter & 0x80) == 0; });
}

// what is known of a word without spaces, from the left, the longest first
std::vector<ColumnWord> known_parts(std::string const& word) {
  std::vector<ColumnWord> parts;
  for (std::size_t at = 0; at < word.size();) {
    std::size_t length = word.size() - at;
    std::optional<ColumnWord> part;
    for (; length > 0 && !part; --length) part = column_word(word.substr(at, length));
    if (part) parts.push_back(*part);
    at += part ? length + 1 : 1;
  }
  return parts;
}

}  // namespace

std::vector<ColumnWord> compound_word(std::string const& word) {
  auto parts = quantity_and_modifier(word);
  if (parts.empty())
    parts = is_ascii(word) ? parts_from(word, 0).value_or(std::vector<ColumnWord>{}) : known_parts(word);
  std::erase_if(parts, [](ColumnWord const& part) { return part.kind == WordKind::filler; });
  auto const last = std::find_if(parts.rbegin(), parts.rend(), [](auto const& part) { return is_quantity(part.kind); });
  if (last == parts.rend()) return {};
  ColumnWord const head = *last;
  std::erase_if(parts, [](ColumnWord const& part) { return is_quantity(part.kind); });
  parts.insert(parts.begin(), head);
  return parts;
}

}  // namespace torquescope
