#include "engine/data/repeated_names.hpp"

#include <algorithm>
#include <map>

namespace torquescope {

std::vector<std::string> with_numbers_of_repeats(std::vector<std::string> names) {
  std::map<std::string, int> count, seen;
  for (auto const& name : names) ++count[name];
  for (auto& name : names) {
    if (count[name] < 2) continue;
    std::string const numbered = name + "#" + std::to_string(++seen[name]);
    // a file that numbers some of its columns so itself keeps its names
    if (!count.contains(numbered)) name = numbered;
  }
  return names;
}

std::string number_of_repeat(std::string const& name) {
  auto const mark = name.rfind('#');
  if (mark == std::string::npos || mark == 0 || mark + 1 == name.size()) return {};
  std::string number = name.substr(mark + 1);
  bool const is_number = std::all_of(number.begin(), number.end(), [](char c) { return c >= '0' && c <= '9'; });
  return is_number ? number : std::string();
}

std::string without_repeat(std::string const& name) {
  auto const number = number_of_repeat(name);
  return number.empty() ? name : name.substr(0, name.size() - number.size() - 1);
}

}  // namespace torquescope
