#pragma once
// The pattern of [[recordings]] (file_pattern.hpp) that the parts of names make.
//
// Threads    functions of their arguments

#include "engine/workflows/drafts/name_parts.hpp"

namespace torquescope {

// quantities that are `fixed` stand as their values; letters that mean something in a pattern become ?
std::string pattern_of(NameParts const& parts, std::map<std::string, std::string> const& fixed = {});
std::string plain_pattern(std::string const& text);

// whether the pattern reads each name as the parts have it: "{motion}_{a}" of "two_sines_1" takes "sines_1" for a
bool gives_back(NameParts const& parts, std::vector<std::string> const& names);

}  // namespace torquescope
