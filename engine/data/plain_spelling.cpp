#include "engine/data/plain_spelling.hpp"

#include <array>

namespace torquescope {

std::string with_plain_brackets(std::string_view name) {
  struct Spelling {
    std::string_view wide, plain;
  };
  static constexpr std::array<Spelling, 6> spellings{
      {{"（", "("}, {"）", ")"}, {"［", "["}, {"］", "]"}, {"【", "["}, {"】", "]"}}};
  std::string plain;
  for (std::size_t at = 0; at < name.size();) {
    std::size_t used = 1;
    std::string_view written = name.substr(at, 1);
    for (auto const& spelling : spellings)
      if (name.substr(at).starts_with(spelling.wide)) {
        used = spelling.wide.size();
        written = spelling.plain;
      }
    plain += written;
    at += used;
  }
  return plain;
}

std::string without_accents(std::string_view word) {
  // the letters of Latin-1 from U+00C0 to U+00DE, whose small ones follow 32 places later
  static constexpr std::array<std::string_view, 32> letters{"a", "a", "a", "a", "a", "a", "ae", "c", "e", "e", "e",
                                                            "e", "i", "i", "i", "i", "d", "n",  "o", "o", "o", "o",
                                                            "o", "",  "o", "u", "u", "u", "u",  "y", "",  "ss"};
  std::string plain;
  for (std::size_t at = 0; at < word.size(); ++at) {
    bool const is_latin = word[at] == '\xc3' && at + 1 < word.size();
    if (!is_latin) {
      plain.push_back(word[at]);
      continue;
    }
    plain += letters[static_cast<unsigned char>(word[++at]) % letters.size()];
  }
  return plain;
}

}  // namespace torquescope
