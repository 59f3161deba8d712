#pragma once
// What `list` and `describe` know, as JSON documents: {"schema": 1, ...}; keys never change their meaning within a
// schema.
//
// Texts      defaults and ranges are texts, as a job file would have them; "" where there is none

#include <string>
#include <vector>

#include "engine/experiment/catalogue.hpp"

namespace torquescope {

// {"schema": 1, "entries": [{"name", "kind", "title"}, ...]}
std::string list_json(std::vector<CatalogueEntry> const& entries);
// the same entries with "text": [lines] and "options": [{"key", "type", "unit", "range", "default", "meaning"}, ...]
std::string describe_json(std::vector<CatalogueEntry> const& entries);

}  // namespace torquescope
