#pragma once
// HDF5 reading a file that is open already: its own driver opens a path, and reads whatever that leads to by then.
//
// Errors     a read that fails is an HDF5 failure with the disk's errno in its words, as of HDF5's own driver; an
//            interrupted one is made again. Zeros behind the end of the file
// Requires   the ReadFile outlives the HDF5 file
// Source     H5FDpublic.h of HDF5 1.10 (H5FD_class_t); H5FDsec2.c for what a driver of files has to do

#include <cstdint>

#include "engine/store/read_file.hpp"

namespace torquescope::h5 {

// puts the driver into a file access property list; false when HDF5 refuses
bool use_input_driver(std::int64_t access_list, ReadFile const& file);

}  // namespace torquescope::h5
