#pragma once
// Elements and attributes of a robot file that its format does not know: its readers pass over them, and a typing error
// would change the arm in silence.
//
// Threads    pure functions

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "engine/robot/xml_element.hpp"

namespace torquescope {

// what may stand in an element. Lists are separated by blanks; children "*": anything, and nobody looks there
struct XmlWords {
  std::string_view element;  // "origin", or "equality/joint" where it differs from other elements of that name
  std::string_view attributes;
  std::string_view children;
};

// a sentence for each unknown word, with file, line and the word that may be meant. Words with a colon belong to others
std::vector<std::string> unknown_words(XmlElement const& root, std::span<XmlWords const> known);

// "arm.urdf:12"
std::string place_text(SourcePlace const& place);

}  // namespace torquescope
