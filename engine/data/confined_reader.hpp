#pragma once
// A recording whose format a foreign library reads (HDF5, matio), read in a process of its own
// (engine/base/confined.hpp).
//
// Errors     what `read` throws; Error 65 when the library crashes, loops or takes too much memory: the file is damaged

#include "engine/data/recording_reader.hpp"

namespace torquescope {

// library: "HDF5", for the message
RawTable read_confined(std::filesystem::path const& path, RawTable (*read)(std::filesystem::path const&),
                       std::string const& library);

}  // namespace torquescope
