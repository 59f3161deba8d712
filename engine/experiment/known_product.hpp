#pragma once
// A product of numbers and quantities, as [known] writes them: "9.80665 * mass_kg * length_m".
//
// Errors     none; what is wrong comes back as a sentence
// Threads    functions of their arguments

#include <map>
#include <string>
#include <vector>

namespace torquescope {

struct KnownProduct {
  std::vector<std::string> factors{};  // as written, in their order
  std::vector<double> numbers{};       // the factors that are numbers
  std::vector<std::string> names{};    // the others: quantities
};

// a number as it stands, the whole text; false: it is none, or not finite
bool read_number(std::string const& text, double& value);

// what is wrong with the text, or ""
std::string read_product(std::string const& text, KnownProduct& product);

// Requires   every name is in `quantities`
double value_of_product(KnownProduct const& product, std::map<std::string, double> const& quantities);

// the text again, with `replacement` in place of each factor `name`
std::string product_with(KnownProduct const& product, std::string const& name, std::string const& replacement);

}  // namespace torquescope
