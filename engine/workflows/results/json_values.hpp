#pragma once
// Numbers and lists as JSON has them: what is no number is null.
//
// Threads    pure functions

#include <cmath>
#include <nlohmann/json.hpp>

namespace torquescope {

inline nlohmann::ordered_json json_number(double value) {
  return std::isfinite(value) ? nlohmann::ordered_json(value) : nlohmann::ordered_json(nullptr);
}

// a list of one object per element
template <class Elements, class Make>
nlohmann::ordered_json json_list(Elements const& elements, Make&& make) {
  nlohmann::ordered_json made = nlohmann::ordered_json::array();
  for (auto const& element : elements) made.push_back(make(element));
  return made;
}

}  // namespace torquescope
