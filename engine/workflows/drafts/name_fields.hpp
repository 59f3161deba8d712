#pragma once
// A file's name taken apart: "2024-01-31_m0.5_two_sines" is a date, m and 0.5, two, sines.
//
// Number     letters or none, a number, perhaps a unit behind it: "m0.5", "150mm", "007"; "m1l150" is two of them
// Date       with or without '-', perhaps with a time behind it
// Threads    functions of their arguments

#include <string>
#include <vector>

namespace torquescope {

enum class FieldKind { word, number, date };

struct NameField {
  std::string separator{};  // what stands before it
  std::string text{};       // all of it
  FieldKind kind = FieldKind::word;
  std::string prefix{}, number{}, unit{};  // of a number
  // equal where two fields hold one quantity: "m#kg"; "" of words and bare numbers
  std::string key() const;
};

// "run.csv.gz" is "run" and ".csv.gz"
std::size_t begin_of_ending(std::string const& name);

// of a name without its ending
std::vector<NameField> fields_of_name(std::string const& name);

// keys that stand once in every name, in one order
std::vector<std::string> common_keys(std::vector<std::vector<NameField>> const& names);

}  // namespace torquescope
