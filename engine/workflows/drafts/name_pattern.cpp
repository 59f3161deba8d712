#include "engine/workflows/drafts/name_pattern.hpp"

#include "engine/experiment/file_pattern.hpp"

namespace torquescope {

std::string plain_pattern(std::string const& text) {
  std::string pattern = text;
  for (char& letter : pattern)
    if (letter == '{' || letter == '}' || letter == '*' || letter == '?') letter = '?';
  return pattern;
}

std::string pattern_of(NameParts const& parts, std::map<std::string, std::string> const& fixed) {
  std::string pattern;
  for (auto const& part : parts.parts) {
    auto const value = fixed.find(part.quantity);
    if (part.is_text)
      pattern += plain_pattern(part.text);
    else if (part.quantity.empty())
      pattern += part.text;
    else
      pattern += value == fixed.end() ? "{" + part.quantity + "}" : plain_pattern(value->second);
  }
  return pattern;
}

bool gives_back(NameParts const& made, std::vector<std::string> const& names) {
  std::string const pattern = pattern_of(made);
  if (!fault_of_pattern(pattern).empty()) return false;
  for (std::size_t k = 0; k < names.size(); ++k)
    if (match_name(pattern, names[k]) != made.values[k]) return false;
  return true;
}

}  // namespace torquescope
