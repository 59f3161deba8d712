#include "engine/workflows/drafts/name_fields.hpp"

#include <algorithm>
#include <cctype>
#include <regex>
#include <string_view>

namespace torquescope {
namespace {

bool is_digit(char c) { return std::isdigit(static_cast<unsigned char>(c)) != 0; }
// bytes beyond ASCII belong to letters
bool is_letter(char c) { return std::isalpha(static_cast<unsigned char>(c)) != 0 || (c & 0x80) != 0; }

// a point between digits is part of a number
bool belongs_to_word(std::string_view name, std::size_t at) {
  if (is_letter(name[at]) || is_digit(name[at])) return true;
  return name[at] == '.' && at > 0 && at + 1 < name.size() && is_digit(name[at - 1]) && is_digit(name[at + 1]);
}

NameField number_field(std::string separator, std::string const& text, std::smatch const& found) {
  return {std::move(separator), text, FieldKind::number, found[1], found[2], found[3]};
}

// one word, or several numbers without a separator: "m1l150kp8"
void add_word(std::vector<NameField>& fields, std::string const& separator, std::string const& word) {
  static std::regex const one("([A-Za-z]*)([0-9]+(?:\\.[0-9]+)?)([A-Za-z]*)"),
      many("(?:[A-Za-z]+[0-9]+(?:\\.[0-9]+)?){2,}"), next("([A-Za-z]+)([0-9]+(?:\\.[0-9]+)?)()");
  std::smatch found;
  if (std::regex_match(word, found, one)) {
    fields.push_back(number_field(separator, word, found));
  } else if (std::regex_match(word, many)) {
    std::string before = separator;
    for (std::sregex_iterator part(word.begin(), word.end(), next), end; part != end; ++part) {
      fields.push_back(number_field(before, part->str(), *part));
      before.clear();
    }
  } else {
    fields.push_back({separator, word});
  }
}

// `separator`: what was left over before the text; returns what is left over behind it
std::string add_words(std::vector<NameField>& fields, std::string separator, std::string const& text) {
  std::string word;
  for (std::size_t at = 0; at < text.size(); ++at) {
    if (belongs_to_word(text, at)) {
      word.push_back(text[at]);
      continue;
    }
    if (!word.empty()) {
      add_word(fields, separator, word);
      separator.clear();
      word.clear();
    }
    separator.push_back(text[at]);
  }
  if (word.empty()) return separator;
  add_word(fields, separator, word);
  return {};
}

}  // namespace

std::string NameField::key() const {
  if (kind == FieldKind::date) return "#date";
  return kind == FieldKind::number && !(prefix.empty() && unit.empty()) ? prefix + "#" + unit : std::string();
}

std::size_t begin_of_ending(std::string const& name) {
  std::size_t begin = name.size();
  for (int k = 0; k < 2; ++k) {
    std::size_t const point = begin == 0 ? std::string::npos : name.rfind('.', begin - 1);
    if (point == std::string::npos || point == 0 || point + 1 >= begin || !is_letter(name[point + 1])) break;
    if (!std::all_of(name.begin() + static_cast<std::ptrdiff_t>(point) + 1,
                     name.begin() + static_cast<std::ptrdiff_t>(begin),
                     [](char c) { return is_letter(c) || is_digit(c); }))
      break;
    begin = point;
  }
  return begin;
}

std::vector<NameField> fields_of_name(std::string const& name) {
  static std::string const time = "(?:[01][0-9]|2[0-3])[-_.:h]?[0-5][0-9](?:[-_.:m]?[0-5][0-9]s?)?",
                           day = "(?:0[1-9]|1[0-2])\\1(?:0[1-9]|[12][0-9]|3[01])";
  // a year of two digits where a time stands behind the day
  static std::regex const date("(?:(?:19|20)[0-9]{2}([-_.]?)" + day + "(?:[T_ -]?" + time +
                               ")?|[0-9]{2}-[0-9]{2}-[0-9]{2}[T_ -]" + time + ")(?![0-9])");
  std::vector<NameField> fields;
  std::string separator;
  auto from = name.begin();
  for (std::sregex_iterator found(name.begin(), name.end(), date), end; found != end; ++found) {
    auto const begin = name.begin() + found->position(), behind = begin + found->length();
    if (begin < from || (begin != name.begin() && is_digit(*(begin - 1)))) continue;
    separator = add_words(fields, separator, std::string(from, begin));
    fields.push_back({separator, found->str(), FieldKind::date});
    separator.clear();
    from = behind;
  }
  separator = add_words(fields, separator, std::string(from, name.end()));
  if (!separator.empty()) fields.push_back({separator, ""});
  return fields;
}

std::vector<std::string> common_keys(std::vector<std::vector<NameField>> const& names) {
  std::vector<std::string> keys;
  std::vector<std::size_t> behind(names.size(), 0);
  for (auto const& field : names.front()) {
    std::string const key = field.key();
    if (key.empty()) continue;
    std::vector<std::size_t> places;
    for (std::size_t k = 0; k < names.size(); ++k) {
      auto const is_it = [&](NameField const& other) { return other.key() == key; };
      if (std::count_if(names[k].begin(), names[k].end(), is_it) != 1) break;
      auto const place = std::find_if(names[k].begin(), names[k].end(), is_it) - names[k].begin();
      if (static_cast<std::size_t>(place) < behind[k]) break;
      places.push_back(static_cast<std::size_t>(place) + 1);
    }
    if (places.size() < names.size()) continue;
    behind = places;
    keys.push_back(key);
  }
  return keys;
}

}  // namespace torquescope
