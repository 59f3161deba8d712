#include "engine/experiment/known_product.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

namespace torquescope {
namespace {

std::string without_blanks_around(std::string const& text) {
  auto const first = text.find_first_not_of(" \t");
  return first == std::string::npos ? "" : text.substr(first, text.find_last_not_of(" \t") - first + 1);
}

// what people try where only products are understood
std::string sign_in(std::string const& factor) {
  auto const at = factor.find_first_of("+-/^()");
  return at == std::string::npos ? "" : factor.substr(at, 1);
}

}  // namespace

bool read_number(std::string const& text, double& value) {
  char const* const end = text.data() + text.size();
  auto const read = std::from_chars(text.data(), end, value);
  return read.ec == std::errc() && read.ptr == end && std::isfinite(value);
}

std::string read_product(std::string const& text, KnownProduct& product) {
  product = {};
  std::size_t begin = 0;
  while (begin <= text.size()) {
    std::size_t const end = std::min(text.find('*', begin), text.size());
    std::string const factor = without_blanks_around(text.substr(begin, end - begin));
    begin = end + 1;
    if (factor.empty()) return text.find('*') == std::string::npos ? "it is empty" : "a factor is missing beside a *";
    double number = 0.0;
    if (read_number(factor, number))
      product.numbers.push_back(number);
    else if (auto const sign = sign_in(factor); !sign.empty())
      return fmt::format("\"{}\" is neither a number nor the name of a quantity: \"{}\" is not understood here", factor,
                         sign);
    else
      product.names.push_back(factor);
    product.factors.push_back(factor);
  }
  return "";
}

double value_of_product(KnownProduct const& product, std::map<std::string, double> const& quantities) {
  double value = 1.0;
  for (double number : product.numbers) value *= number;
  for (auto const& name : product.names) value *= quantities.at(name);
  return value;
}

std::string product_with(KnownProduct const& product, std::string const& name, std::string const& replacement) {
  std::string text;
  for (auto const& factor : product.factors)
    text += (text.empty() ? "" : " * ") + (factor == name ? replacement : factor);
  return text;
}

}  // namespace torquescope
