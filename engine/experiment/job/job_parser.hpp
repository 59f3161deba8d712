#pragma once
// The text of a job to its sections, with places.

#include <string>
#include <vector>

#include "engine/base/options.hpp"

namespace torquescope {

// Errors     Error 78 with every place, see job.hpp; a syntax error ends the reading, other problems are collected
std::vector<Section> parse_sections(std::string const& text, std::string const& file);

}  // namespace torquescope
