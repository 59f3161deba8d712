#pragma once
// Reads in a process of its own what will be read here: whatever HDF5 does there with a file that nobody vouches for,
// this process lives on.
//
// Errors     those of `look`; 65 when HDF5 crashes, loops or takes too much memory
// Threads    as run_confined (confined.hpp)

#include <filesystem>
#include <functional>

#include "engine/store/result_reader.hpp"

namespace torquescope {

void look_at_result(std::filesystem::path const& file, std::function<void(ResultReader const&)> const& look);

}  // namespace torquescope
