#pragma once
// From the word of an option to its enumerator: the words stand in the order of the enum.

#include <algorithm>
#include <string>
#include <vector>

#include "engine/base/contract.hpp"

namespace torquescope {

// the option table has checked the word
template <class Choice>
Choice named_choice(std::vector<std::string> const& words, std::string const& word) {
  auto const found = std::find(words.begin(), words.end(), word);
  TORQUESCOPE_EXPECT(found != words.end());
  return static_cast<Choice>(found - words.begin());
}

}  // namespace torquescope
