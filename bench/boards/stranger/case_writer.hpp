#pragma once
// Writes a case as a laboratory would hand it over: two recordings and a job; and, apart from them, the truth.
#include <filesystem>

#include "stranger/recording.hpp"

namespace stranger {

void write_case(Case const& which, std::filesystem::path const& folder, Options const& options);

}  // namespace stranger
