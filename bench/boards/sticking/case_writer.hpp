#pragma once
// Writes train.csv, validate.csv, job.toml and truth.json of a case into a folder.

#include <filesystem>

#include "sticking/drawn_case.hpp"

namespace sticking {

// std::runtime_error where a file cannot be written
void write_case(Case const& which, std::filesystem::path const& folder);

}  // namespace sticking
