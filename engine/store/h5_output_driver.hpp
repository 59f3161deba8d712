#pragma once
// HDF5 writing through a TempFile: HDF5 believes that every write succeeds, the TempFile knows better.
//
// Why        after a failed write HDF5 1.10 crashes in its exit handler (h5py#914, HDFGroup/hdf5#1498, #2291), and a
// close
//            that returns success proves nothing. Building the file in memory (core driver) avoids both, but a history
//            of 2 GB then takes 2 GB of memory.
// Values     where raw data was written last, and not metadata, is kept in `values` (file_seal.hpp)
// Requires   the TempFile and `values` outlive the HDF5 file
// Source     H5FDpublic.h of HDF5 1.10 (H5FD_class_t)

#include <cstdint>

#include "engine/store/byte_ranges.hpp"
#include "engine/store/temp_file.hpp"

namespace torquescope::h5 {

// puts the driver into a file access property list; false when HDF5 refuses
bool use_output_driver(std::int64_t access_list, TempFile& file, ByteRanges& values);

}  // namespace torquescope::h5
