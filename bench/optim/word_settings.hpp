#pragma once
// Settings of an optimiser from words of the command line, and what its runs spent as one line.

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <string>
#include <vector>

#include "engine/base/options.hpp"

namespace torquescope::bench {

template <class Number>
bool reads_as(std::string const& text, Number& number) {
  auto const [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  return error == std::errc{} && end == text.data() + text.size();
}

// "key=value"; a whole number, a number, or a word
inline Setting setting_of(std::string const& word) {
  auto const split = word.find('=');
  std::string const key = word.substr(0, split), value = split == std::string::npos ? "" : word.substr(split + 1);
  std::int64_t whole = 0;
  double real = 0.0;
  if (reads_as(value, whole)) return {key, whole};
  if (reads_as(value, real)) return {key, real};
  return {key, value};
}

// reached of all, median and expected running time; spent: 0 where the budget ended first
inline std::string summary_of(std::vector<std::int64_t> const& spent, std::int64_t budget) {
  std::vector<std::int64_t> needed;
  std::int64_t all = 0;
  for (auto const evaluations : spent) {
    if (evaluations > 0) needed.push_back(evaluations);
    all += evaluations > 0 ? evaluations : budget;
  }
  std::sort(needed.begin(), needed.end());
  auto const n = static_cast<std::int64_t>(needed.size());
  bool const has_median = 2 * needed.size() > spent.size();
  return fmt::format("{:>2}/{}{:>9}{:>9}", n, spent.size(),
                     has_median ? fmt::format("{}", needed[spent.size() / 2]) : "-",
                     n > 0 ? fmt::format("{}", all / n) : "-");
}

}  // namespace torquescope::bench
