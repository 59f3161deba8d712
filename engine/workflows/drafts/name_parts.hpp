#pragma once
// What the names of many recordings tell: of "m0.5_l150_kp8_steps.csv" and its like mass_kg, length_mm, kp and motion.
//
// Numbers    named by the letters before them or the unit behind (m, l, kp, v, T; kg, mm, V), else a, b, ...
// Words      those that differ most are `motion`, others a, b, ...; dates and times that differ are any letters: * or ?
// Constant   a number that is the same in all names is a quantity where two of them have a known name, else text
// Threads    function of its argument

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace torquescope {

struct NamePart {
  std::string text{};      // in all names; of what has no name * or ?
  std::string quantity{};  // the name of what differs, "" where it has none
  bool is_text = true;
};

struct NameQuantity {
  std::string name;         // "mass_kg", "motion", "a"
  std::string written;      // how the first name has it: "m0.5"
  bool is_number = true;    // false: words
  bool is_a_guess = false;  // a, b: nobody knows what it is
};

struct NameParts {
  std::vector<NamePart> parts{};
  std::vector<NameQuantity> quantities{};                  // in the order of the names
  std::vector<std::map<std::string, std::string>> values;  // of each name
};

// names without folders; nothing where no pattern could say what they have in common
std::optional<NameParts> parts_of_names(std::vector<std::string> const& names);

}  // namespace torquescope
